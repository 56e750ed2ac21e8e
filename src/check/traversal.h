// Rays through primitives on a device: by the tree or by testing every primitive.
#pragma once

#include "bvh/bvh.h"
#include "compute/program.h"
#include "math/shared.h"

#include <cstdint>
#include <map>
#include <string>
#include <vector>

namespace etendue
{
struct TestRay {
    float origin[3], direction[3];
    float t_max;
    uint from = NO_INDEX; // primitives that the ray does not meet, see cl/geometry/ray.h
    uint to = NO_INDEX;
};

// What became of each ray, as bits, so that two results are equal when every bit is.
struct TracedRays {
    std::vector<uint> valid;     // is_valid_ray, 0 or 1; rays that are not valid are not traced
    std::vector<uint> t;         // bits of the float; t_max where nothing is met
    std::vector<uint> primitive; // NO_INDEX where nothing is met
    std::vector<uint> b1, b2;    // bits of the floats
    std::vector<uint> occluded;
    std::vector<uint> complete; // of both queries, for all rays of a pack: the stack was large enough

    float distance(std::size_t i) const;
};

// A sentence for each of the first few rays whose results differ, but for `complete`; none when all bits are equal.
std::vector<std::string> differences(const TracedRays& a, const TracedRays& b, const std::vector<TestRay>& rays);

// Rays of the given number on which traversal goes wrong: random, along axes with zeros of both signs, at vertices and
// edges, from vertices, from and between surfaces; one in 16 is not a valid ray.
std::vector<TestRay> nasty_rays(const std::vector<Primitive>& primitives, std::size_t count, unsigned seed);

// Is a ray one that can be traced? Finite, with a direction, and a t_max of at least zero.
bool is_valid(const TestRay& ray);

// Primitives with the host's tree.
class TraversalScene
{
public:
    explicit TraversalScene(std::vector<Primitive> primitives);

    const std::vector<Primitive>& primitives() const { return primitives_; }
    const Bvh& bvh() const { return bvh_; }
    Bvh& bvh() { return bvh_; }

private:
    std::vector<Primitive> primitives_;
    Bvh bvh_;
};

// The functions that trace, compiled for a device and a size of the stack when they are first called. lanes 0: as many
// as suit the device. Rays that are not valid are inactive lanes.
class TraversalKernels
{
public:
    explicit TraversalKernels(const Device& device, std::uint32_t stack_size = 64)
        : device_(device), stack_size_(stack_size)
    {
    }

    // scene_closest_hit and scene_occluded by ACCELERATOR_LBVH or ACCELERATOR_BRUTE_FORCE.
    TracedRays trace(const TraversalScene& scene, const std::vector<TestRay>& rays, AcceleratorType accelerator,
                     std::uint32_t lanes = 0);

    // leaf_closest_hit and leaf_any_hit of these primitives in this order, as one leaf.
    TracedRays trace_leaf(const TraversalScene& scene, const std::vector<TestRay>& rays, const std::vector<uint>& leaf,
                          std::uint32_t lanes = 0);

    // Nodes that each ray alone visits when no hit shortens it; 0 when the stack was too small.
    std::vector<uint> visits(const TraversalScene& scene, const std::vector<TestRay>& rays);

private:
    std::vector<uint> run(const std::string& kernel, const TraversalScene& scene, const std::vector<uint>& leaves,
                          AcceleratorType accelerator, const std::vector<TestRay>& rays, std::uint32_t lanes);

    const Device& device_;
    std::uint32_t stack_size_;
    std::map<std::uint32_t, Program> programs_;
};
} // namespace etendue
