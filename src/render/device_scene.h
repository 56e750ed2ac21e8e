// A scene on one device: its buffers, only those that exist, and its tree.
#pragma once

#include "bvh/bvh_builder.h"
#include "compute/buffer.h"
#include "compute/kernel.h"
#include "geometry/geometry.h"
#include "math/shared.h"
#include "render/precision.h"

#include <string>
#include <variant>

namespace etendue
{
class DeviceScene
{
public:
    // Upload, and build the tree when settings ask for it: in float, whatever the precision. Throws DeviceError,
    // BuildError, SceneError.
    DeviceScene(const Device& device, const Geometry& geometry, const RenderSettings& settings, BvhPlace place,
                const KernelCache& cache, Precision precision = Precision::single);

    const BvhStatistics& bvh_statistics() const { return bvh_.bvh.statistics; }
    const std::string& bvh_warning() const { return bvh_.warning; }
    LbvhBuilder* bvh_builder() { return bvh_.builder.get(); } // null when no kernel built the tree
    double upload_seconds() const { return upload_seconds_; }
    double bvh_seconds() const { return bvh_seconds_; }

    // Launch a kernel whose first arguments are SCENE_ARGUMENTS (cl/shared/scene_view.h), then `rest`.
    template<typename... Arguments>
    void launch(Kernel& kernel, std::size_t global_size, std::size_t local_size, const Arguments&... rest) const
    {
        std::visit(
            [&](const auto& reals) {
                kernel.launch(global_size, local_size, reals.settings, reals.nodes, bvh_.bvh.leaf_primitives,
                              reals.primitives, surfaces_, reals.normals, materials_, reals.parameters, reals.lights,
                              light_table_, rest...);
            },
            reals_);
    }

private:
    // The arrays with reals in them.
    template<typename Reals>
    struct RealBuffers {
        Buffer<typename Reals::Settings> settings;
        Buffer<typename Reals::Shape> primitives;
        Buffer<typename Reals::Node> nodes;
        Buffer<typename Reals::Real4> normals;
        Buffer<typename Reals::Real> parameters;
        Buffer<typename Reals::Emitter> lights;
    };
    template<typename Reals>
    static RealBuffers<Reals> upload(const Device& device, const Geometry& geometry, const RenderSettings& settings);
    void build_tree(const Device& device, const Geometry& geometry, BvhPlace place, const KernelCache& cache);

    std::variant<RealBuffers<SingleReals>, RealBuffers<DoubleReals>> reals_;
    Buffer<PrimitiveSurface> surfaces_;
    Buffer<Material> materials_;
    Buffer<AliasBucket> light_table_;
    BvhBuild bvh_; // its nodes are in reals_
    double upload_seconds_ = 0.0;
    double bvh_seconds_ = 0.0;
};
} // namespace etendue
