// Bins of directions that hold about equal shares of a distribution, so that a lobe of a ten-thousandth of a radian is
// looked into as finely as one that fills the hemisphere.
#pragma once

#include "check/direction.h"

#include <array>
#include <cstddef>
#include <functional>
#include <vector>

namespace etendue
{
class EqualMassBins
{
public:
    // Each side of the surface is halved at the median of the pilot's directions, in azimuth and in cosine by turns, as
    // long as a bin holds two shares of pilot.size() / count of them. A side with none of them is one bin. All must be
    // finite.
    EqualMassBins(const std::vector<Direction>& pilot, std::size_t count);

    std::size_t count() const { return bin_count_; }

    // The bin of a unit vector; the two sides of z = 0 are told by its sign.
    std::size_t bin_of(const Direction& w) const;

    // A density per solid angle, of many directions at once.
    using Density = std::function<std::vector<float>(const std::vector<Direction>&)>;

    // Integral of the density over each bin, by Gauss's rule of 3x3 points on cells that are not much larger than the
    // patch of the pilot's directions in them, and are quartered until that changes the integral by less than a
    // thousandth of a bin's share, or ten times.
    std::vector<double> integrate(const Density& density) const;

private:
    // Of the plane of turns (azimuth over 2 pi) and depths (1 - |cosine|), in which areas are solid angles over 2 pi.
    using Place = std::array<double, 2>;
    struct Cell {
        bool below = false; // z < 0
        Place low{0, 0}, high{1, 1};
        std::size_t bin = 0;
    };
    struct Node {
        std::size_t axis = 0, children = 0, bin = 0; // without children a leaf: a bin
        double split = 0;
    };

    static Place place_of(const Direction& w);
    static Direction direction_at(const Cell& cell, double turn, double depth);
    static std::array<Cell, 4> quarters_of(const Cell& cell);
    static std::vector<double> integrate_cells(const std::vector<Cell>& cells, const Density& density);
    void grow(std::size_t node, const Cell& cell, Place* first, Place* last, std::size_t axis, std::size_t share);
    void add_cells(const Cell& cell, Place* first, Place* last);

    std::vector<Node> nodes_; // the sides above and below come first
    std::size_t bin_count_ = 0;
    std::vector<Cell> cells_; // together the bins
};
} // namespace etendue
