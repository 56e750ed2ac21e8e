// Whether a tree is one. Nothing here is shared with the builders: primitives are measured in double precision.
#include "bvh/bvh_check.h"

#include "math/bounds.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <fmt/format.h>
#include <optional>

namespace etendue
{
namespace
{
Vec3 xyz(const real4& v)
{
    return {v.s[0], v.s[1], v.s[2]};
}

bool is_finite(const Vec3& v)
{
    return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

// What the primitive occupies, unpadded; nothing when it is not finite in single precision.
std::optional<Bounds> primitive_bounds(const Primitive& primitive)
{
    const Vec3 a = xyz(primitive.a);
    Bounds bounds;
    if (primitive.a.s[3] == PRIMITIVE_TRIANGLE) {
        if (!is_finite(a) || !is_finite(xyz(primitive.b)) || !is_finite(xyz(primitive.c))) return {};
        for (const Vec3& vertex : {a, xyz(primitive.b), xyz(primitive.c)}) bounds.extend(vertex);
    } else {
        Vec3 half(std::fabs(primitive.b.s[0]));
        if (primitive.a.s[3] == PRIMITIVE_DISK) {
            const Vec3 n = xyz(primitive.b);
            half = std::fabs(static_cast<double>(primitive.c.s[0])) * glm::sqrt(glm::max(1.0 - n * n, Vec3(0.0)));
        }
        if (!is_finite(a) || !is_finite(half)) return {};
        bounds.extend(a - half);
        bounds.extend(a + half);
    }
    const double largest = std::numeric_limits<float>::max() * (1.0 - 1e-6);
    if (glm::any(glm::greaterThan(glm::max(glm::abs(bounds.lower), glm::abs(bounds.upper)), Vec3(largest)))) return {};
    return bounds;
}

// The box of child 0 or 1.
Bounds child_bounds(const BvhNode& node, std::size_t child)
{
    const std::size_t k = 2 * child;
    return {{node.x.s[k], node.y.s[k], node.z.s[k]}, {node.x.s[k + 1], node.y.s[k + 1], node.z.s[k + 1]}};
}

bool contains(const Bounds& outer, const Bounds& inner)
{
    return glm::all(glm::lessThanEqual(outer.lower, inner.lower)) &&
           glm::all(glm::greaterThanEqual(outer.upper, inner.upper));
}

class Checker
{
public:
    Checker(const Bvh& bvh, const std::vector<Primitive>& primitives)
        : bvh_(bvh), primitives_(primitives), node_visits_(bvh.nodes.size()), position_visits_(primitives.size())
    {
    }

    std::vector<std::string> check()
    {
        if (bvh_.nodes.empty()) return {"The tree has no nodes."};
        if (bvh_.leaf_primitives.size() != primitives_.size())
            return {fmt::format("The leaves list {} primitives, the scene has {}.", bvh_.leaf_primitives.size(),
                                primitives_.size())};
        check_permutation();
        walk();
        for (std::size_t i = 0; i < node_visits_.size(); ++i)
            if (node_visits_[i] == 0) report("Node {} is never reached.", i);
        for (std::size_t i = 0; i < position_visits_.size(); ++i)
            if (position_visits_[i] != 1) report("Position {} is in {} leaves.", i, position_visits_[i]);
        check_statistics();
        return std::move(violations_);
    }

private:
    struct Visit {
        uint node;
        uint depth;
        std::optional<Bounds> box; // as the parent stores it
    };

    template<typename... Arguments>
    void report(fmt::format_string<Arguments...> text, Arguments&&... arguments)
    {
        constexpr std::size_t LIMIT = 100;
        if (violations_.size() < LIMIT) violations_.push_back(fmt::format(text, std::forward<Arguments>(arguments)...));
    }

    void check_permutation()
    {
        std::vector<uint> listed(primitives_.size());
        for (std::size_t i = 0; i < bvh_.leaf_primitives.size(); ++i) {
            const uint primitive = bvh_.leaf_primitives[i];
            if (primitive < listed.size())
                ++listed[primitive];
            else
                report("Position {} lists primitive {}, of {}.", i, primitive, primitives_.size());
        }
        for (std::size_t i = 0; i < listed.size(); ++i)
            if (listed[i] != 1) report("Primitive {} is listed {} times.", i, listed[i]);
    }

    void walk()
    {
        std::vector<Visit> stack{{0, 1, {}}};
        while (!stack.empty()) {
            const Visit visit = stack.back();
            stack.pop_back();
            if (node_visits_[visit.node]++ > 0) {
                report("Node {} is reached more than once.", visit.node);
                continue;
            }
            depth_ = std::max(depth_, visit.depth);
            for (std::size_t c = 0; c < 2; ++c) check_child(visit, c, stack);
        }
    }

    void check_child(const Visit& visit, std::size_t c, std::vector<Visit>& stack)
    {
        const BvhNode& node = bvh_.nodes[visit.node];
        const uint reference = node.child.s[c], count = node.child.s[c + 2];
        const Bounds box = child_bounds(node, c);
        if (!box.empty() && (!is_finite(box.lower) || !is_finite(box.upper)))
            report("The box of child {} of node {} is not finite.", c, visit.node);
        if (visit.box && !box.empty() && !contains(*visit.box, box))
            report("The box of node {} does not contain that of its child {}.", visit.node, c);
        if (reference & LEAF_BIT)
            check_leaf(visit.node, c, reference & ~LEAF_BIT, count, box);
        else if (count != 0)
            report("Child {} of node {} is a node and a leaf of {}.", c, visit.node, count);
        else if (reference >= bvh_.nodes.size())
            report("Child {} of node {} is node {}, of {}.", c, visit.node, reference, bvh_.nodes.size());
        else
            stack.push_back({reference, visit.depth + 1, box});
    }

    void check_leaf(uint node, std::size_t c, uint first, uint count, const Bounds& box)
    {
        if (count == 0 && primitives_.size() < 2) {
            if (!box.empty()) report("The empty leaf of node {} has a box that rays meet.", node);
            return;
        }
        if (count == 0 || count > MAX_LEAF_PRIMITIVES) report("Leaf {} of node {} has {} primitives.", c, node, count);
        ++leaf_count_;
        if (first > position_visits_.size() || count > position_visits_.size() - first) {
            report("Leaf {} of node {} ends at position {}, of {}.", c, node, std::uint64_t{first} + count,
                   position_visits_.size());
            return;
        }
        for (uint position = first; position < first + count; ++position) {
            ++position_visits_[position];
            check_primitive(node, c, first, position, box);
        }
    }

    void check_primitive(uint node, std::size_t c, uint first, uint position, const Bounds& box)
    {
        const uint id = bvh_.leaf_primitives[position], first_id = bvh_.leaf_primitives[first];
        if (id >= primitives_.size() || first_id >= primitives_.size()) return;
        const Primitive& primitive = primitives_[id];
        if (primitive.a.s[3] != primitives_[first_id].a.s[3])
            report("Leaf {} of node {} holds primitives of different kinds.", c, node);
        const std::optional<Bounds> bounds = primitive_bounds(primitive);
        if (bounds && !contains(box, *bounds))
            report("The box of leaf {} of node {} does not contain primitive {}.", c, node, id);
    }

    void check_statistics()
    {
        const std::size_t n = primitives_.size();
        const uint bound = 63u + static_cast<uint>(n < 2 ? 1 : std::bit_width(n - 1));
        const BvhStatistics& s = bvh_.statistics;
        if (depth_ > bound) report("The tree is {} deep; {} primitives allow {}.", depth_, n, bound);
        if (s.depth != depth_) report("The statistics say depth {}, the tree has {}.", s.depth, depth_);
        if (s.node_count != bvh_.nodes.size())
            report("The statistics say {} nodes, the tree has {}.", s.node_count, bvh_.nodes.size());
        if (s.leaf_count != leaf_count_)
            report("The statistics say {} leaves, the tree has {}.", s.leaf_count, leaf_count_);
        if (s.primitive_count != n) report("The statistics say {} primitives, the scene has {}.", s.primitive_count, n);
    }

    const Bvh& bvh_;
    const std::vector<Primitive>& primitives_;
    std::vector<uint> node_visits_, position_visits_;
    std::vector<std::string> violations_;
    uint depth_ = 0, leaf_count_ = 0;
};
} // namespace

std::vector<std::string> check_bvh(const Bvh& bvh, const std::vector<Primitive>& primitives)
{
    return Checker(bvh, primitives).check();
}
} // namespace etendue
