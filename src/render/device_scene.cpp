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

template<typename Reals>
DeviceScene::RealBuffers<Reals> DeviceScene::upload(const Device& device, const Geometry& geometry,
                                                    const RenderSettings& settings)
{
    RealBuffers<Reals> buffers;
    buffers.settings = {device, "settings", std::vector{in_reals<Reals>(settings)}};
    buffers.primitives = {device, "primitives", in_reals<Reals>(at_least_one(geometry.primitives))};
    buffers.normals = {device, "vertex normals", in_reals<Reals>(geometry.normals)};
    buffers.parameters = {device, "material parameters", in_reals<Reals>(geometry.parameters)};
    buffers.lights = {device, "lights", in_reals<Reals>(geometry.lights)};
    return buffers;
}

DeviceScene::DeviceScene(const Device& device, const Geometry& geometry, const RenderSettings& settings, BvhPlace place,
                         const KernelCache& cache, Precision precision)
{
    Stopwatch watch;
    if (precision == Precision::fp64)
        reals_ = upload<DoubleReals>(device, geometry, settings);
    else
        reals_ = upload<SingleReals>(device, geometry, settings);
    surfaces_ = Buffer<PrimitiveSurface>(device, "surfaces", at_least_one(geometry.surfaces));
    materials_ = Buffer<Material>(device, "materials", geometry.materials);
    light_table_ = Buffer<AliasBucket>(device, "light table", geometry.light_table);
    upload_seconds_ = watch.restart();
    if (settings.accelerator != ACCELERATOR_LBVH) return;
    build_tree(device, geometry, place, cache);
    bvh_seconds_ = watch.seconds();
}

void DeviceScene::build_tree(const Device& device, const Geometry& geometry, BvhPlace place, const KernelCache& cache)
{
    if (auto* single = std::get_if<RealBuffers<SingleReals>>(&reals_)) {
        bvh_ = build_bvh(place, device, cache, geometry.primitives, single->primitives);
        single->nodes = std::move(bvh_.bvh.nodes);
        return;
    }
    // Boxes of the float tree hold what double rays meet, too: they are padded by float's roundings.
    const Buffer<Primitive> primitives(device, "primitives in float", geometry.primitives);
    bvh_ = build_bvh(place, device, cache, geometry.primitives, primitives);
    std::get<RealBuffers<DoubleReals>>(reals_).nodes = {device, "BVH nodes", widen(bvh_.bvh.nodes.read())};
    bvh_.bvh.nodes = {};
}
} // namespace etendue
