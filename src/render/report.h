// report.json: everything a render knows about itself.
#pragma once

#include "geometry/geometry.h"
#include "render/error_target.h"
#include "render/render_report.h"
#include "scene/scene.h"

#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <json/value.h>

namespace etendue
{
// Phases of the whole program, in order: name and seconds.
using Phases = std::vector<std::pair<std::string, double>>;

// The report as JSON text. `relative_error` is the film's estimate; `command` the command line; `target` what was
// rendered for, if it was an error.
std::string report_json(const Scene& scene, const Geometry& geometry, const RenderReport& report, const Phases& phases,
                        double relative_error, const std::string& command,
                        const std::optional<ErrorTarget::Report>& target = {});

// What the canary of a device found, for reports.
Json::Value canary_json(const CanaryReport& canary);

// What is written into the picture: scene and its hash, seed, spp, device, versions, seconds per phase; "interrupted"
// when it was.
std::map<std::string, std::string> image_metadata(const Scene& scene, const RenderReport& report, const Phases& phases);
} // namespace etendue
