// A k-d tree over samples, and adaptive quadrature over its leaves.
#include "check/equal_mass_bins.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>

namespace etendue
{
namespace
{
constexpr double PI = std::numbers::pi;

// Nodes and weights of Gauss's rule on [0, 1].
const double NODES[3] = {0.5 - std::sqrt(0.15), 0.5, 0.5 + std::sqrt(0.15)};
constexpr double WEIGHTS[3] = {5.0 / 18.0, 8.0 / 18.0, 5.0 / 18.0};

// Cells are at most so much longer than the patch of directions in them, of which a few make no patch.
constexpr double LARGEST_CELL = 4;
constexpr std::ptrdiff_t FEW_DIRECTIONS = 8;

constexpr int MAX_QUARTERINGS = 10;
constexpr double TOLERANCE = 1e-3; // of a bin's share
} // namespace

EqualMassBins::EqualMassBins(const std::vector<Direction>& pilot, std::size_t count) : nodes_(2)
{
    std::array<std::vector<Place>, 2> places;
    for (const Direction& w : pilot) places[std::signbit(w[2])].push_back(place_of(w));
    for (const std::size_t side : {0u, 1u}) {
        std::vector<Place>& all = places[side];
        grow(side, {side == 1, {0, 0}, {1, 1}, 0}, all.data(), all.data() + all.size(), 0, pilot.size() / count);
    }
}

void EqualMassBins::grow(std::size_t node, const Cell& cell, Place* first, Place* last, std::size_t axis,
                         std::size_t share)
{
    const auto less = [axis](const Place& a, const Place& b) { return a[axis] < b[axis]; };
    const auto size = static_cast<std::size_t>(last - first);
    Place* const middle = first + size / 2;
    double split = cell.low[axis];
    if (size >= 2 * std::max<std::size_t>(share, 1)) {
        // Split between the two in the middle.
        std::nth_element(first, middle, last, less);
        split = 0.5 * ((*middle)[axis] + (*std::max_element(first, middle, less))[axis]);
    }
    if (!(split > cell.low[axis] && split < cell.high[axis])) {
        Cell bin = cell;
        bin.bin = nodes_[node].bin = bin_count_++;
        return add_cells(bin, first, last);
    }
    const std::size_t children = nodes_.size();
    nodes_[node] = {axis, children, 0, split};
    nodes_.resize(children + 2);
    Cell low = cell, high = cell;
    low.high[axis] = high.low[axis] = split;
    grow(children, low, first, middle, 1 - axis, share);
    grow(children + 1, high, middle, last, 1 - axis, share);
}

// Halve the cell until the directions in it fill a good part of it. What is left over are larger and larger cells away
// from them, in which a lobe's tail is found.
void EqualMassBins::add_cells(const Cell& cell, Place* first, Place* last)
{
    for (const std::size_t axis : {0u, 1u}) {
        if (last - first < FEW_DIRECTIONS) break;
        const auto [least, most] =
            std::minmax_element(first, last, [axis](const Place& a, const Place& b) { return a[axis] < b[axis]; });
        const double middle = 0.5 * (cell.low[axis] + cell.high[axis]);
        const double patch = (*most)[axis] - (*least)[axis];
        // Directions on one line, or as good as that, make no patch.
        if (!(patch > 0 && cell.low[axis] < middle && middle < cell.high[axis])) continue;
        if (cell.high[axis] - cell.low[axis] <= LARGEST_CELL * patch) continue;
        Place* const split = std::partition(first, last, [&](const Place& p) { return p[axis] < middle; });
        Cell low = cell, high = cell;
        low.high[axis] = high.low[axis] = middle;
        add_cells(low, first, split);
        return add_cells(high, split, last);
    }
    cells_.push_back(cell);
}

EqualMassBins::Place EqualMassBins::place_of(const Direction& w)
{
    const double x = w[0], y = w[1], z = std::abs(w[2]);
    const double turn = std::atan2(y, x) / (2 * PI);
    // 1 - |z| without cancellation where z is nearly 1, and without the rounding of x and y where it is nearly 0.
    const double depth = z > 0.5 ? (x * x + y * y) / (1 + z) : 1 - z;
    return {turn - std::floor(turn), depth};
}

Direction EqualMassBins::direction_at(const Cell& cell, double turn, double depth)
{
    const double radius = std::sqrt(depth * (2 - depth)), z = 1 - depth;
    return {static_cast<float>(radius * std::cos(2 * PI * turn)), static_cast<float>(radius * std::sin(2 * PI * turn)),
            static_cast<float>(cell.below ? -z : z)};
}

std::size_t EqualMassBins::bin_of(const Direction& w) const
{
    const Place place = place_of(w);
    const Node* node = &nodes_[std::signbit(w[2])];
    while (node->children != 0) node = &nodes_[node->children + (place[node->axis] >= node->split)];
    return node->bin;
}

std::array<EqualMassBins::Cell, 4> EqualMassBins::quarters_of(const Cell& cell)
{
    std::array<Cell, 4> quarters;
    for (std::size_t i = 0; i < 4; ++i) {
        quarters[i] = cell;
        for (const std::size_t axis : {0u, 1u}) {
            const double middle = 0.5 * (cell.low[axis] + cell.high[axis]);
            ((i >> axis) & 1u ? quarters[i].low : quarters[i].high)[axis] = middle;
        }
    }
    return quarters;
}

std::vector<double> EqualMassBins::integrate_cells(const std::vector<Cell>& cells, const Density& density)
{
    std::vector<Direction> directions;
    directions.reserve(9 * cells.size());
    for (const Cell& cell : cells)
        for (const double x : NODES)
            for (const double y : NODES)
                directions.push_back(direction_at(cell, std::lerp(cell.low[0], cell.high[0], x),
                                                  std::lerp(cell.low[1], cell.high[1], y)));
    const std::vector<float> values = density(directions);
    std::vector<double> integrals;
    for (std::size_t i = 0; i < cells.size(); ++i) {
        double mean = 0;
        for (std::size_t k = 0; k < 9; ++k) mean += WEIGHTS[k / 3] * WEIGHTS[k % 3] * values[9 * i + k];
        const Cell& cell = cells[i];
        integrals.push_back(mean * 2 * PI * (cell.high[0] - cell.low[0]) * (cell.high[1] - cell.low[1]));
    }
    return integrals;
}

std::vector<double> EqualMassBins::integrate(const Density& density) const
{
    const double tolerance = TOLERANCE / static_cast<double>(count());
    std::vector<double> sums(count(), 0.0);
    std::vector<Cell> cells = cells_;
    std::vector<double> coarse = integrate_cells(cells, density);
    for (int round = 1; !cells.empty(); ++round) {
        std::vector<Cell> quarters, next;
        for (const Cell& cell : cells)
            for (const Cell& quarter : quarters_of(cell)) quarters.push_back(quarter);
        const std::vector<double> fine = integrate_cells(quarters, density);
        std::vector<double> next_coarse;
        for (std::size_t i = 0; i < cells.size(); ++i) {
            const double sum = fine[4 * i] + fine[4 * i + 1] + fine[4 * i + 2] + fine[4 * i + 3];
            if (std::abs(sum - coarse[i]) <= tolerance || round == MAX_QUARTERINGS) {
                sums[cells[i].bin] += sum;
                continue;
            }
            for (std::size_t k = 4 * i; k < 4 * i + 4; ++k) {
                next.push_back(quarters[k]);
                next_coarse.push_back(fine[k]);
            }
        }
        cells = std::move(next);
        coarse = std::move(next_coarse);
    }
    return sums;
}
} // namespace etendue
