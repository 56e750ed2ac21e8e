// A scene on one device: its buffers, only those that exist, and its tree.
#pragma once

#include "bvh/bvh_builder.h"
#include "compute/buffer.h"
#include "compute/kernel.h"
#include "geometry/geometry.h"
#include "math/shared.h"

#include <string>

namespace etendue
{
class DeviceScene
{
public:
    // Upload, and build the tree when settings ask for it. Throws DeviceError, BuildError, SceneError.
    DeviceScene(const Device& device, const Geometry& geometry, const RenderSettings& settings, BvhPlace place,
                const KernelCache& cache);

    const BvhStatistics& bvh_statistics() const { return bvh_.bvh.statistics; }
    const std::string& bvh_warning() const { return bvh_.warning; }
    LbvhBuilder* bvh_builder() { return bvh_.builder.get(); } // null when no kernel built the tree
    double upload_seconds() const { return upload_seconds_; }
    double bvh_seconds() const { return bvh_seconds_; }

    // Launch a kernel whose first arguments are SCENE_ARGUMENTS (cl/shared/scene_view.h), then `rest`.
    template<typename... Arguments>
    void launch(Kernel& kernel, std::size_t global_size, std::size_t local_size, const Arguments&... rest) const
    {
        kernel.launch(global_size, local_size, settings_, bvh_.bvh.nodes, bvh_.bvh.leaf_primitives, primitives_,
                      surfaces_, normals_, materials_, parameters_, lights_, light_table_, rest...);
    }

private:
    Buffer<RenderSettings> settings_;
    Buffer<Primitive> primitives_;
    Buffer<PrimitiveSurface> surfaces_;
    Buffer<real4> normals_;
    Buffer<Material> materials_;
    Buffer<real> parameters_;
    Buffer<Light> lights_;
    Buffer<AliasBucket> light_table_;
    BvhBuild bvh_;
    double upload_seconds_ = 0.0;
    double bvh_seconds_ = 0.0;
};
} // namespace etendue
