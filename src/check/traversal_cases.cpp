// Sets of primitives, each with what goes wrong on it.
#include "check/traversal_cases.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <random>
#include <stdexcept>

namespace etendue
{
namespace
{
// An icosphere of 20 * 4^levels triangles: closed, every edge shared by two of them.
std::vector<Primitive> icosphere(int levels)
{
    using Vertex = std::array<double, 3>;
    const auto unit = [](Vertex v) {
        const double length = std::sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
        return Vertex{v[0] / length, v[1] / length, v[2] / length};
    };
    const double g = (1 + std::sqrt(5.0)) / 2;
    const std::vector<Vertex> v{{-1, g, 0},  {1, g, 0},  {-1, -g, 0}, {1, -g, 0}, {0, -1, g},  {0, 1, g},
                                {0, -1, -g}, {0, 1, -g}, {g, 0, -1},  {g, 0, 1},  {-g, 0, -1}, {-g, 0, 1}};
    const int faces[20][3] = {{0, 11, 5},  {0, 5, 1},  {0, 1, 7},  {0, 7, 10}, {0, 10, 11}, {1, 5, 9}, {5, 11, 4},
                              {11, 10, 2}, {10, 7, 6}, {7, 1, 8},  {3, 9, 4},  {3, 4, 2},   {3, 2, 6}, {3, 6, 8},
                              {3, 8, 9},   {4, 9, 5},  {2, 4, 11}, {6, 2, 10}, {8, 6, 7},   {9, 8, 1}};
    std::vector<std::array<Vertex, 3>> mesh;
    for (const auto& f : faces) mesh.push_back({unit(v[f[0]]), unit(v[f[1]]), unit(v[f[2]])});
    for (int level = 0; level < levels; ++level) {
        std::vector<std::array<Vertex, 3>> finer;
        for (const auto& [a, b, c] : mesh) {
            const auto middle = [&](const Vertex& p, const Vertex& q) {
                return unit({p[0] + q[0], p[1] + q[1], p[2] + q[2]});
            };
            const Vertex ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
            finer.insert(finer.end(), {{a, ab, ca}, {ab, b, bc}, {ca, bc, c}, {ab, bc, ca}});
        }
        mesh = std::move(finer);
    }
    std::vector<Primitive> set;
    const auto real = [](const Vertex& p) { return make_real4(p[0], p[1], p[2]); };
    for (const auto& [a, b, c] : mesh) set.push_back(make_triangle(real(a), real(b), real(c)));
    return set;
}

// Pairs that share a plane y = const and overlap, half of them listed the other way round, some sharing all vertices.
std::vector<Primitive> coplanar_pairs(std::size_t pairs)
{
    std::mt19937 random(5);
    std::uniform_real_distribution<double> u(-1, 1);
    std::vector<Primitive> first, second;
    for (std::size_t i = 0; i < pairs; ++i) {
        const double x = u(random), y = std::round(4 * u(random)) / 4, z = u(random), shift = i % 3 ? 0.05 : 0.0;
        const real4 a = make_real4(x, y, z), b = make_real4(x + 0.3, y, z), c = make_real4(x, y, z + 0.3);
        const real4 d = make_real4(x + shift, y, z + shift), e = make_real4(x + shift, y, z + 0.3 + shift),
                    f = make_real4(x + 0.3 + shift, y, z + shift);
        first.push_back(make_triangle(a, b, c));
        second.push_back(i % 2 ? make_triangle(d, f, e) : make_triangle(d, e, f));
    }
    std::shuffle(second.begin(), second.end(), random);
    first.insert(first.end(), second.begin(), second.end());
    return first;
}

std::vector<Primitive> mixed(std::size_t count)
{
    std::mt19937 random(11);
    std::uniform_real_distribution<double> u(-1, 1);
    std::vector<Primitive> set = soup(count / 3);
    for (std::size_t i = 0; i < count / 3; ++i) set.push_back(make_sphere(u(random), u(random), u(random), 0.1));
    for (std::size_t i = 0; i < count / 3; ++i) set.push_back(make_disk(u(random), u(random), u(random), 0.1));
    return set;
}

// Coordinates of any bits at all: huge, tiny, subnormal, infinite, not a number.
std::vector<Primitive> random_bits(std::size_t count)
{
    std::mt19937 random(13);
    std::vector<Primitive> set = random_triangles(count / 2, 17);
    const auto any_float = [&] {
        const std::uint32_t bits = static_cast<std::uint32_t>(random());
        float value;
        std::memcpy(&value, &bits, sizeof value);
        return value;
    };
    for (std::size_t i = 0; i < count / 2; ++i) {
        Primitive p = make_triangle({}, {}, {});
        for (int axis = 0; axis < 3; ++axis) {
            p.a.s[axis] = any_float();
            p.b.s[axis] = any_float();
            p.c.s[axis] = any_float();
        }
        set.push_back(p);
    }
    return set;
}

// Sizes from 2^-30 to 2^30: the products of three coordinates in the triangle test stay normal numbers.
std::vector<Primitive> huge_and_tiny(std::size_t count)
{
    std::mt19937 random(19);
    std::uniform_real_distribution<double> u(-1, 1);
    std::vector<Primitive> set;
    for (std::size_t i = 0; i < count; ++i) {
        const double size = std::ldexp(1.0, static_cast<int>(30 * u(random)));
        const double x = size * u(random), y = size * u(random), z = size * u(random);
        set.push_back(triangle_at(x, y, z, 0.5 * size));
    }
    return set;
}

// Centres at 2^-i on each axis: the tree splits off one triangle at each bit of the Morton code.
std::vector<Primitive> one_split_per_bit()
{
    std::vector<Primitive> set{triangle_at(0, 0, 0, 0x1p-30)};
    for (int bit = 0; bit < 21; ++bit)
        for (int axis = 0; axis < 3; ++axis) {
            double centre[3] = {0, 0, 0};
            centre[axis] = std::ldexp(1.0, -bit);
            set.push_back(triangle_at(centre[0], centre[1], centre[2], std::ldexp(1.0, -bit - 3)));
        }
    return set;
}

const std::vector<Primitive>& primitive_set(const std::string& name)
{
    static const std::vector<PrimitiveSet> sets = primitive_sets();
    for (const PrimitiveSet& set : sets)
        if (set.name == name) return set.primitives;
    throw std::logic_error("There is no set of primitives " + name + ".");
}

} // namespace

std::vector<Primitive> soup(std::size_t count)
{
    std::mt19937 random(3);
    std::uniform_real_distribution<double> u(-1, 1);
    std::vector<Primitive> set;
    const auto point = [&](double scale) {
        return std::array<double, 3>{scale * u(random), scale * u(random), scale * u(random)};
    };
    for (std::size_t i = 0; i < count; ++i) {
        const auto p = point(1), e = point(0.3), f = point(0.3);
        set.push_back(make_triangle(make_real4(p[0], p[1], p[2]), make_real4(p[0] + e[0], p[1] + e[1], p[2] + e[2]),
                                    make_real4(p[0] + f[0], p[1] + f[1], p[2] + f[2])));
    }
    return set;
}

std::vector<TestRay> tied_rays(const std::vector<TestRay>& rays, const TracedRays& traced)
{
    std::vector<TestRay> tied;
    for (std::size_t i = 0; i < rays.size(); ++i) {
        if (traced.primitive[i] == NO_INDEX) continue;
        const float t = traced.distance(i);
        for (const float t_max : {std::nextafter(t, 0.0f), t, std::nextafter(t, 2 * t)}) {
            tied.push_back(rays[i]);
            tied.back().t_max = t_max;
        }
    }
    return tied;
}

std::vector<TraversalCase> traversal_cases()
{
    return {
        {"soup", soup(2000), 28000},
        {"closed mesh", icosphere(3), 28000},
        {"coplanar pairs", coplanar_pairs(500), 21000},
        {"mixed kinds", mixed(1500), 21000},
        {"random bits", random_bits(600), 14000},
        {"identical", primitive_set("identical"), 224},
        {"nested", primitive_set("nested around one centre"), 1400},
        {"clustered", primitive_set("clustered"), 2800},
        {"deep", one_split_per_bit(), 7000},
        {"of no size", primitive_set("split at every bit of the code"), 700},
        {"some not finite", primitive_set("some not finite"), 7000},
        {"none finite", primitive_set("none finite"), 700},
        {"huge and tiny", huge_and_tiny(500), 7000},
        {"kinds on one spot", primitive_set("kinds on one spot"), 1400},
        {"no primitive", {}, 70},
        {"one", primitive_set("1 random triangles"), 700},
        {"two", primitive_set("2 random triangles"), 700},
        {"three", primitive_set("3 random triangles"), 700},
    };
}
} // namespace etendue
