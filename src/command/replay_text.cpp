// Tables and JSON of replayed paths.
#include "command/replay_text.h"

#include "command/vertex_values.h"
#include "render/render_report.h"
#include "scene/material_parser.h"

#include <json/json.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include <fmt/format.h>

namespace etendue
{
namespace
{
using Vertex = fp64::PathVertex;

std::string number_text(double x, Precision precision)
{
    x += 0.0; // no -0
    return precision == Precision::fp64 ? fmt::format("{:.12g}", x) : fmt::format("{:.8g}", x);
}

std::string value_text(const Quantity& q, const Normalisation& normalisation, Precision precision)
{
    const Vec3 v = in_world(q, normalisation);
    if (is_single_number(q)) return number_text(v.x, precision);
    return fmt::format("{}, {}, {}", number_text(v.x, precision), number_text(v.y, precision),
                       number_text(v.z, precision));
}

const char* kind_name(const Primitive& primitive)
{
    const int kind = static_cast<int>(primitive.a.s[3]);
    return kind == PRIMITIVE_SPHERE ? "sphere" : kind == PRIMITIVE_DISK ? "disk" : "triangle";
}

std::string accident_text(std::uint32_t code)
{
    return fmt::format("{} at vertex {}", health_name(code % 16 - 1), code / 16);
}

// "triangle 12, diffuse material "white", from outside"
std::string what_is_met(const Vertex& v, const ReplayedPath& path)
{
    if (v.primitive == NO_INDEX) return "nothing: the path leaves the scene";
    const MaterialDescription& material = path.scene->materials.at(v.material);
    return fmt::format("{} {}, {} material \"{}\"{}{}", kind_name(path.geometry->primitives.at(v.primitive)),
                       v.primitive, bsdf_name(material.bsdf), material.name, v.inside ? ", from behind" : "",
                       v.light != NO_INDEX ? fmt::format(", light {}", v.light) : "");
}

std::string how_it_goes_on(const Vertex& v)
{
    std::string text = v.goes_on ? v.delta ? "goes on, by a delta lobe" : "goes on" : "ends here";
    if (v.accident) text += ": " + accident_text(v.accident);
    return text;
}

// One row: a name, what float says, and, where there is a twin, what double says and how far off float is.
void add_row(std::string& text, const std::string& name, const std::string& single, const std::string& twin = "",
             const std::string& difference = "")
{
    std::string row = fmt::format("  {:<17}{:<42}", name, single);
    if (!twin.empty()) row += fmt::format(" {:<52} {}", twin, difference);
    row.erase(row.find_last_not_of(' ') + 1);
    text += row + '\n';
}

void add_vertex(std::string& text, const ReplayedPath& path, std::size_t i)
{
    const auto& a = path.single.vertices;
    static const std::vector<Vertex> none;
    const auto& b = path.twin ? path.twin->vertices : none;
    const bool both = i < a.size() && i < b.size();
    text += fmt::format("vertex {}\n", i);
    // What the paths meet stands in full lines, once where they agree.
    if (i < a.size()) add_row(text, both ? "fp32 meets" : "meets", what_is_met(a[i], path));
    if (i < b.size()) add_row(text, "fp64 meets", what_is_met(b[i], path));
    const auto& n = path.geometry->normalisation;
    const auto qa = i < a.size() ? quantities_of(path.single, i) : std::vector<Quantity>{};
    const auto qb = i < b.size() ? quantities_of(*path.twin, i) : std::vector<Quantity>{};
    for (const Quantity& q : qa.size() >= qb.size() ? qa : qb) {
        const auto of = [&](const std::vector<Quantity>& all) {
            return std::find_if(all.begin(), all.end(),
                                [&](const Quantity& x) { return x.name == std::string(q.name); });
        };
        const auto in_a = of(qa), in_b = of(qb);
        const bool in_both = in_a != qa.end() && in_b != qb.end();
        add_row(text, q.name, in_a == qa.end() ? "-" : value_text(*in_a, n, Precision::single),
                in_b == qb.end() ? (path.twin ? "-" : "") : value_text(*in_b, n, Precision::fp64),
                in_both && is_compared(q) ? fmt::format("{:.2g}", difference(*in_a, *in_b)) : "");
    }
    add_row(text, "then", i < a.size() ? how_it_goes_on(a[i]) : "-",
            i < b.size() ? how_it_goes_on(b[i])
            : path.twin  ? "-"
                         : "");
}

std::string verdict(const ReplayedPath& path)
{
    if (!path.twin)
        return fmt::format("{} has no double precision, so there is no fp64 path to compare with.\n", path.device);
    const PathDifference d = compare_paths(path.single, *path.twin);
    const std::string before = d.largest == 0.0
                                   ? std::string("nothing differs")
                                   : fmt::format("the largest relative difference is {:.3g}, of the {} at vertex {}",
                                                 d.largest, d.quantity, d.vertex);
    if (d.parts_at) return fmt::format("The paths part at vertex {}; before it {}.\n", *d.parts_at, before);
    return fmt::format("The paths meet the same primitives; {}.\n", before);
}

// JSON has no infinity: as texts they are not lost.
Json::Value number_json(double x)
{
    if (std::isfinite(x)) return Json::Value(x);
    return Json::Value(std::isnan(x) ? "nan" : x > 0.0 ? "inf" : "-inf");
}

Json::Value vector_json(const Vec3& v)
{
    Json::Value json(Json::arrayValue);
    for (int c = 0; c < 3; ++c) json.append(number_json(v[c]));
    return json;
}

std::string json_key(std::string name)
{
    std::replace(name.begin(), name.end(), ' ', '_');
    return name;
}

Json::Value vertex_json(const ReplayedPath& path, const PathRecord& record, std::size_t i)
{
    const Vertex& v = record.vertices[i];
    Json::Value json;
    json["primitive"] = v.primitive == NO_INDEX ? Json::Value() : Json::Value(v.primitive);
    if (v.primitive != NO_INDEX) {
        json["kind"] = kind_name(path.geometry->primitives.at(v.primitive));
        json["material"] = path.scene->materials.at(v.material).name;
        json["bsdf"] = bsdf_name(static_cast<BsdfType>(v.bsdf));
        json["light"] = v.light == NO_INDEX ? Json::Value() : Json::Value(v.light);
        json["from_behind"] = v.inside != 0;
        json["delta"] = v.delta != 0;
    }
    json["goes_on"] = v.goes_on != 0;
    for (const Quantity& q : quantities_of(record, i)) {
        const Vec3 value = in_world(q, path.geometry->normalisation);
        json[json_key(q.name)] = is_single_number(q) ? number_json(value.x) : vector_json(value);
    }
    return json;
}

Json::Value path_json(const ReplayedPath& path, const PathRecord& record)
{
    Json::Value json;
    json["vertex_count"] = record.vertex_count;
    json["radiance"] = vector_json(record.radiance);
    json["accident"] = Json::Value();
    if (record.accident) {
        json["accident"]["kind"] = health_name(record.accident % 16 - 1);
        json["accident"]["vertex"] = record.accident / 16;
    }
    json["vertices"] = Json::Value(Json::arrayValue);
    for (std::size_t i = 0; i < record.vertices.size(); ++i) json["vertices"].append(vertex_json(path, record, i));
    return json;
}
} // namespace

std::string replay_text(const ReplayedPath& path)
{
    std::string text = fmt::format("{}: pixel {},{} sample {} seed {} on {}\n", path.scene->file, path.sample.x,
                                   path.sample.y, path.sample.sample, path.scene->sampler.seed, path.device);
    if (path.twin) add_row(text, "", "fp32", "fp64", "difference");
    const std::size_t count =
        std::max(path.single.vertices.size(), path.twin ? path.twin->vertices.size() : std::size_t{0});
    for (std::size_t i = 0; i < count; ++i) add_vertex(text, path, i);
    if (path.single.vertex_count > path.single.vertices.size())
        text += fmt::format("... and {} more vertices\n", path.single.vertex_count - path.single.vertices.size());
    const Quantity single{"radiance", Quantity::Kind::colour, path.single.radiance};
    const auto& n = path.geometry->normalisation;
    text += "sample\n";
    if (path.twin) {
        const Quantity twin{"radiance", Quantity::Kind::colour, path.twin->radiance};
        add_row(text, "radiance", value_text(single, n, Precision::single), value_text(twin, n, Precision::fp64),
                fmt::format("{:.2g}", difference(single, twin)));
    } else {
        add_row(text, "radiance", value_text(single, n, Precision::single));
    }
    if (path.single.accident) text += "fp32 counts as zero because of " + accident_text(path.single.accident) + ".\n";
    if (path.twin && path.twin->accident)
        text += "fp64 counts as zero because of " + accident_text(path.twin->accident) + ".\n";
    return text + verdict(path);
}

std::string replay_json(const ReplayedPath& path)
{
    Json::Value json;
    json["scene"] = path.scene->file;
    json["device"] = path.device;
    json["seed"] = Json::Value(static_cast<Json::UInt64>(path.scene->sampler.seed));
    json["pixel"].append(path.sample.x);
    json["pixel"].append(path.sample.y);
    json["sample"] = Json::Value(static_cast<Json::UInt64>(path.sample.sample));
    json["fp32"] = path_json(path, path.single);
    json["fp64"] = path.twin ? path_json(path, *path.twin) : Json::Value();
    if (path.twin) {
        const PathDifference d = compare_paths(path.single, *path.twin);
        json["parts_at"] = d.parts_at ? Json::Value(*d.parts_at) : Json::Value();
        json["largest_difference"]["value"] = number_json(d.largest);
        json["largest_difference"]["vertex"] = d.vertex;
        json["largest_difference"]["quantity"] = d.quantity;
    }
    Json::StreamWriterBuilder writer;
    writer["indentation"] = "  ";
    writer["precision"] = 17;
    return Json::writeString(writer, json) + "\n";
}
} // namespace etendue
