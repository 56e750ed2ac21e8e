// The linear BVH in plain C++. Ranges of the sorted order are split recursively; inner node i has i at one end of its
// range, as in Karras's numbering: the first child of a split after position s is node s, the second is node s + 1.
#include "bvh/lbvh_host.h"

#include "bvh/morton.h"
#include "util/error.h"
#include "util/stopwatch.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <utility>

namespace etendue
{
namespace
{
struct Key {
    std::uint64_t code;
    uint primitive;
};

// Stable, least significant digit first; a digit that all keys share needs no pass.
void sort_keys(std::vector<Key>& keys)
{
    std::vector<Key> other(keys.size());
    for (unsigned shift = 0; shift < 64; shift += RADIX_BITS) {
        std::array<std::size_t, RADIX_SIZE> next{};
        for (const Key& key : keys) ++next[key.code >> shift & (RADIX_SIZE - 1)];
        if (std::ranges::find(next, keys.size()) != next.end()) continue;
        std::size_t sum = 0;
        for (std::size_t& n : next) sum += std::exchange(n, sum);
        for (const Key& key : keys) other[next[key.code >> shift & (RADIX_SIZE - 1)]++] = key;
        keys.swap(other);
    }
}

// What a subtree is to its parent. Cost in half areas.
struct Subtree {
    Box box;
    float cost = 0.0f;
    uint kinds = 0; // bit k: has primitives of kind k
    uint depth = 0; // inner nodes on the longest way down
    bool is_leaf = true;
    uint reference = 0; // as in BvhNode, but inner nodes by their number before compaction
    uint count = 0;     // as in BvhNode
};

BvhNode make_node(const Subtree& a, const Subtree& b)
{
    const Box &p = a.box, &q = b.box;
    return {{{p.lower[0], p.upper[0], q.lower[0], q.upper[0]}},
            {{p.lower[1], p.upper[1], q.lower[1], q.upper[1]}},
            {{p.lower[2], p.upper[2], q.lower[2], q.upper[2]}},
            {{a.reference, b.reference, a.count, b.count}}};
}

class TreeBuilder
{
public:
    TreeBuilder(const std::vector<Primitive>& primitives, const std::vector<Box>& boxes, const std::vector<Key>& keys)
        : keys_(keys), leaves_(keys.size()), nodes_(keys.size() - 1)
    {
        // Fetched in one sweep; one by one in the recursion, each would be waited for.
        for (std::size_t i = 0; i < keys.size(); ++i)
            leaves_[i] = {boxes[keys[i].primitive], primitive_kind(primitives[keys[i].primitive])};
    }

    // The subtree over sorted positions first..last, whose inner node is number `index`.
    Subtree build(uint first, uint last, uint index)
    {
        if (first == last) return primitive_subtree(first);
        const uint split = split_position(first, last);
        const Subtree a = build(first, split, split);
        const Subtree b = build(split + 1, last, split + 1);
        nodes_[index] = make_node(a, b);
        return parent_of(a, b, first, last, index);
    }

    // Keep what is reachable from the root, in the order of the numbers.
    std::vector<BvhNode> compact()
    {
        std::vector<uint> new_index(nodes_.size(), NO_INDEX);
        std::vector<uint> stack{0};
        while (!stack.empty()) {
            const uint index = stack.back();
            stack.pop_back();
            new_index[index] = 0;
            for (std::size_t c = 0; c < 2; ++c)
                if (!(nodes_[index].child.s[c] & LEAF_BIT)) stack.push_back(nodes_[index].child.s[c]);
        }
        uint count = 0;
        for (uint& index : new_index)
            if (index != NO_INDEX) index = count++;
        for (std::size_t i = 0; i < nodes_.size(); ++i) {
            if (new_index[i] == NO_INDEX) continue;
            BvhNode node = nodes_[i];
            for (std::size_t c = 0; c < 2; ++c)
                if (!(node.child.s[c] & LEAF_BIT)) node.child.s[c] = new_index[node.child.s[c]];
            nodes_[new_index[i]] = node;
        }
        nodes_.resize(count);
        return std::move(nodes_);
    }

private:
    Subtree primitive_subtree(uint position) const
    {
        const auto& [box, kind] = leaves_[position];
        return {box, box.half_area(), 1u << kind, 0, true, LEAF_BIT | position, 1};
    }

    // The last position of the first child: where the highest differing bit of the codes, or of the positions of equal
    // codes, goes from 0 to 1.
    uint split_position(uint first, uint last) const
    {
        const std::uint64_t difference = keys_[first].code ^ keys_[last].code;
        if (difference == 0) {
            const int bit = static_cast<int>(std::bit_width(first ^ last)) - 1;
            return (last >> bit << bit) - 1;
        }
        const int bit = static_cast<int>(std::bit_width(difference)) - 1;
        const auto begin = keys_.begin();
        const auto second = std::partition_point(begin + first, begin + last + 1,
                                                 [bit](const Key& key) { return (key.code >> bit & 1) == 0; });
        return static_cast<uint>(second - begin) - 1;
    }

    // A leaf when that is not dearer, its primitives are few and of one kind, and it is not the root.
    static Subtree parent_of(const Subtree& a, const Subtree& b, uint first, uint last, uint index)
    {
        Subtree s;
        s.box = a.box;
        s.box.extend(b.box);
        s.kinds = a.kinds | b.kinds;
        const uint primitive_count = last - first + 1;
        const float area = s.box.half_area();
        const float inner_cost = area + (a.cost + b.cost);
        const float leaf_cost = static_cast<float>(primitive_count) * area;
        s.is_leaf = index != 0 && std::has_single_bit(s.kinds) && primitive_count <= MAX_LEAF_PRIMITIVES &&
                    leaf_cost <= inner_cost;
        s.cost = s.is_leaf ? leaf_cost : inner_cost;
        s.depth = s.is_leaf ? 0 : 1 + std::max(a.depth, b.depth);
        s.reference = s.is_leaf ? LEAF_BIT | first : index;
        s.count = s.is_leaf ? primitive_count : 0;
        return s;
    }

    struct Leaf {
        Box box;
        uint kind = 0;
    };

    const std::vector<Key>& keys_;
    std::vector<Leaf> leaves_; // in sorted order
    std::vector<BvhNode> nodes_;
};

// No inner node exists: the one primitive, if any, beside an empty leaf.
BvhNode make_lone_node(const std::vector<Primitive>& primitives, const std::vector<Box>& boxes)
{
    Subtree nothing, only;
    nothing.reference = only.reference = LEAF_BIT;
    if (!primitives.empty()) {
        only.box = boxes[0];
        only.count = 1;
    }
    return make_node(only, nothing);
}
} // namespace

Bvh build_bvh_host(const std::vector<Primitive>& primitives)
{
    check_primitive_count(primitives.size());
    const uint count = static_cast<uint>(primitives.size());
    Bvh bvh;
    BvhStatistics& statistics = bvh.statistics;
    Stopwatch watch;
    const auto end_phase = [&](const char* name) { statistics.phases.emplace_back(name, watch.restart()); };

    std::vector<Box> boxes(count);
    std::ranges::transform(primitives, boxes.begin(), primitive_box);
    end_phase("boxes");

    const MortonGrid grid = morton_grid(boxes);
    std::vector<Key> keys(count);
    for (uint i = 0; i < count; ++i) keys[i] = {morton_code(grid, boxes[i]), i};
    end_phase("codes");

    sort_keys(keys);
    bvh.leaf_primitives.resize(count);
    std::ranges::transform(keys, bvh.leaf_primitives.begin(), &Key::primitive);
    end_phase("sort");

    Subtree root;
    if (count < 2) {
        bvh.nodes.push_back(make_lone_node(primitives, boxes));
        root.depth = 1;
        if (count == 1) root.cost = 2.0f * (root.box = boxes[0]).half_area();
    } else {
        TreeBuilder builder(primitives, boxes, keys);
        root = builder.build(0, count - 1, 0);
        end_phase("hierarchy, boxes and leaves");
        bvh.nodes = builder.compact();
    }
    end_phase("compaction");

    statistics.primitive_count = count;
    statistics.node_count = static_cast<uint>(bvh.nodes.size());
    statistics.leaf_count = count < 2 ? count : statistics.node_count + 1;
    statistics.depth = root.depth;
    statistics.sah_cost = relative_cost(root.cost, root.box.half_area());
    return bvh;
}

double relative_cost(float cost, float half_area)
{
    return half_area > 0.0f && std::isfinite(cost) ? static_cast<double>(cost) / static_cast<double>(half_area) : 0.0;
}

void check_primitive_count(std::size_t count)
{
    if (count < LEAF_BIT) return;
    throw SceneError("A scene holds at most " + std::to_string(LEAF_BIT - 1u) + " primitives; this one has " +
                     std::to_string(count) + ".");
}
} // namespace etendue
