// Uploading a scene.
#include "render/device_scene.h"

#include "util/stopwatch.h"

namespace etendue
{
namespace
{
// Lanes without a hit read the first element and ignore it, so there must be one even where nothing can be hit.
template<typename T>
std::vector<T> at_least_one(const std::vector<T>& elements)
{
    return elements.empty() ? std::vector<T>(1) : elements;
}
} // namespace

DeviceScene::DeviceScene(const Device& device, const Geometry& geometry, const RenderSettings& settings, BvhPlace place,
                         const KernelCache& cache)
{
    Stopwatch watch;
    settings_ = Buffer<RenderSettings>(device, "settings", {settings});
    primitives_ = Buffer<Primitive>(device, "primitives", at_least_one(geometry.primitives));
    surfaces_ = Buffer<PrimitiveSurface>(device, "surfaces", at_least_one(geometry.surfaces));
    normals_ = Buffer<real4>(device, "vertex normals", geometry.normals);
    materials_ = Buffer<Material>(device, "materials", geometry.materials);
    parameters_ = Buffer<real>(device, "material parameters", geometry.parameters);
    lights_ = Buffer<Light>(device, "lights", geometry.lights);
    light_table_ = Buffer<AliasBucket>(device, "light table", geometry.light_table);
    upload_seconds_ = watch.restart();
    if (settings.accelerator != ACCELERATOR_LBVH) return;
    bvh_ = build_bvh(place, device, cache, geometry.primitives, primitives_);
    bvh_seconds_ = watch.seconds();
}
} // namespace etendue
