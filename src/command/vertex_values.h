// What a replay tells of a vertex, value by value, and how far two paths agree.
#pragma once

#include "geometry/geometry.h"
#include "math/vector.h"
#include "render/replay.h"

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace etendue
{
// What is told of a vertex: lengths in normalised coordinates, radiance since the vertex before.
struct Quantity {
    enum class Kind { place, length, direction, number, colour };
    const char* name;
    Kind kind;
    Vec3 value; // numbers and lengths in x
};

// Of vertex i of a path, in the order in which they are printed.
std::vector<Quantity> quantities_of(const PathRecord& path, std::size_t i);

// Numbers and lengths have one value, the other kinds three.
bool is_single_number(const Quantity& q);

// In the scene's own units.
Vec3 in_world(const Quantity& q, const Normalisation& normalisation);

// How far apart two values of a quantity are: of numbers and colours relative to the larger one, else absolute. 0 for
// what is equal, infinite values and NaN included.
double difference(const Quantity& a, const Quantity& b);
// Whether the difference means something: error bounds differ by the precision's nature, and what a vertex adds is a
// difference of sums that cancels; the sums themselves are compared.
bool is_compared(const Quantity& q);

// How far two records of one path agree.
struct PathDifference {
    std::optional<std::uint32_t> parts_at; // first vertex that lies on another primitive, or that only one path has
    // The largest relative difference at the vertices before: of lengths relative to the scene's half-extent, of unit
    // vectors absolute; 0 where everything is equal.
    double largest = 0.0;
    std::uint32_t vertex = 0; // where it is
    std::string quantity;     // what it is of
};
PathDifference compare_paths(const PathRecord& a, const PathRecord& b);
} // namespace etendue
