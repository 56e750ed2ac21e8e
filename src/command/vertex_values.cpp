// From records of vertices to values.
#include "command/vertex_values.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace etendue
{
namespace
{
Vec3 xyz(const fp64::real4& v)
{
    return Vec3(v.s[0], v.s[1], v.s[2]);
}
} // namespace

std::vector<Quantity> quantities_of(const PathRecord& path, std::size_t i)
{
    using Of = Quantity::Kind;
    const fp64::PathVertex& v = path.vertices[i];
    const Vec3 before = i == 0 ? Vec3(0.0) : xyz(path.vertices[i - 1].radiance);
    std::vector<Quantity> all;
    if (v.primitive != NO_INDEX)
        all = {{"distance", Of::length, Vec3(v.geometric_normal.s[3])},
               {"position", Of::place, xyz(v.position)},
               {"error bound", Of::length, Vec3(v.position.s[3])},
               {"geometric normal", Of::direction, xyz(v.geometric_normal)},
               {"shading normal", Of::direction, xyz(v.shading_normal)}};
    // A light found by chance, with the density of light samples that could have found it.
    all.insert(all.end(), {{"emission met", Of::colour, xyz(v.emission) - before},
                           {"as light sample", Of::number, Vec3(v.light_pdfs.s[2])}});
    if (v.primitive != NO_INDEX) {
        all.insert(all.end(), {{"light sampled", Of::colour, xyz(v.radiance) - xyz(v.emission)},
                               {"light's pdf", Of::number, Vec3(v.light_pdfs.s[0])},
                               {"as BSDF sample", Of::number, Vec3(v.light_pdfs.s[1])},
                               {"next direction", Of::direction, xyz(v.direction)},
                               {"its pdf", Of::number, Vec3(v.shading_normal.s[3])},
                               {"throughput", Of::colour, xyz(v.throughput)}});
    }
    all.push_back({"radiance", Of::colour, xyz(v.radiance)});
    return all;
}

bool is_single_number(const Quantity& q)
{
    return q.kind == Quantity::Kind::number || q.kind == Quantity::Kind::length;
}

Vec3 in_world(const Quantity& q, const Normalisation& normalisation)
{
    if (q.kind == Quantity::Kind::place) return q.value / normalisation.scale + normalisation.centre;
    if (q.kind == Quantity::Kind::length) return q.value / normalisation.scale;
    return q.value;
}

double difference(const Quantity& a, const Quantity& b)
{
    const bool same = std::equal(&a.value.x, &a.value.x + 3, &b.value.x,
                                 [](double x, double y) { return x == y || (std::isnan(x) && std::isnan(y)); });
    if (same) return 0.0;
    const double distance = glm::length(a.value - b.value);
    const bool relative = a.kind == Quantity::Kind::number || a.kind == Quantity::Kind::colour;
    const double d = relative ? distance / std::max(glm::length(a.value), glm::length(b.value)) : distance;
    return std::isnan(d) ? std::numeric_limits<double>::infinity() : d;
}

bool is_compared(const Quantity& q)
{
    const std::string name = q.name;
    return name != "error bound" && name != "emission met" && name != "light sampled";
}

PathDifference compare_paths(const PathRecord& a, const PathRecord& b)
{
    PathDifference result;
    const std::size_t common = std::min(a.vertices.size(), b.vertices.size());
    std::size_t i = 0;
    for (; i < common && a.vertices[i].primitive == b.vertices[i].primitive; ++i) {
        const auto qa = quantities_of(a, i), qb = quantities_of(b, i);
        for (std::size_t q = 0; q < qa.size(); ++q) {
            const double d = is_compared(qa[q]) ? difference(qa[q], qb[q]) : 0.0;
            if (d <= result.largest) continue;
            result.largest = d;
            result.vertex = static_cast<std::uint32_t>(i);
            result.quantity = qa[q].name;
        }
    }
    if (i < common || a.vertices.size() != b.vertices.size()) result.parts_at = static_cast<std::uint32_t>(i);
    return result;
}
} // namespace etendue
