// Brute-force intersection, the path loop, and batches on two threads.
#include "support/reference_tracer.h"

#include "support/reference_shapes.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <random>
#include <thread>

namespace etendue
{
using std::numbers::pi;

namespace
{
using Shape = ReferenceShape;

struct Sampler {
    std::mt19937_64 engine;
    double next() { return static_cast<double>(engine() >> 11) * 0x1p-53; } // in [0, 1)
    Vec2 next_2d() { return {next(), next()}; }
};

class Tracer
{
public:
    Tracer(const Scene& scene, const ReferenceOptions& options)
        : scene_(scene), options_(options), shapes_(make_reference_shapes(scene))
    {
        double largest = 0.0;
        for (const Shape& shape : shapes_) {
            for (const Vec3& p : {shape.a, shape.a + shape.edge1, shape.a + shape.edge2, shape.a + shape.radius})
                largest = std::max({largest, std::abs(p.x), std::abs(p.y), std::abs(p.z)});
            if (!shape.description->emission) continue;
            lights_.push_back(&shape);
            light_area_ += shape.area;
            cumulative_area_.push_back(light_area_);
        }
        epsilon_ = 1e-12 * largest;
    }

    std::vector<Vec3> render(std::uint32_t batch) const; // one value per pixel

private:
    const Shape* closest(const Vec3& origin, const Vec3& direction, const Shape* from, double& distance) const
    {
        const Shape* found = nullptr;
        for (const Shape& shape : shapes_) {
            if (&shape == from && shape.kind != Shape::Kind::sphere) continue;
            const double t = shape.intersect(origin, direction, epsilon_);
            if (t > epsilon_ && t < distance) distance = t, found = &shape;
        }
        return found;
    }
    Vec3 sampled_light(const Vec3& p, const Vec3& n, const Shape* from, Sampler& sampler) const;
    Vec3 radiance(Vec3 origin, Vec3 direction, Sampler& sampler) const;

    const Scene& scene_;
    const ReferenceOptions& options_;
    std::vector<Shape> shapes_;
    std::vector<const Shape*> lights_;
    std::vector<double> cumulative_area_;
    double light_area_ = 0.0;
    double epsilon_ = 0.0; // least distance of a hit, metres
};

// Light of a uniform point of all lights, scattered by Lambert's law of albedo 1: L cos cos' A / (pi r^2).
Vec3 Tracer::sampled_light(const Vec3& p, const Vec3& n, const Shape* from, Sampler& sampler) const
{
    if (lights_.empty()) return Vec3(0.0);
    const auto found = std::upper_bound(cumulative_area_.begin(), cumulative_area_.end(), sampler.next() * light_area_);
    const Shape& light = *lights_[std::min<std::size_t>(found - cumulative_area_.begin(), lights_.size() - 1)];
    const Vec3 q = light.sample_point(sampler.next_2d());
    const double r = distance(p, q);
    const Vec3 w = (q - p) / r;
    const double cosine = dot(n, w), light_cosine = -dot(light.normal_at(q), w);
    if (!(cosine > 0.0)) return Vec3(0.0);
    double unoccluded = r * (1.0 - 1e-9);
    if (closest(p, w, from, unoccluded)) return Vec3(0.0);
    return light.emitted(light_cosine) * (cosine * std::abs(light_cosine) * light_area_ / (pi * r * r));
}

// Specular reflection or refraction, chosen by Fresnel's law for unpolarised light. Returns the factor of radiance,
// which is concentrated in the denser medium by the square of the ratio of the indices.
double scatter_dielectric(Vec3& direction, const Vec3& n, double eta, Sampler& sampler)
{
    const double cosine = -dot(direction, n), sine2 = eta * eta * (1.0 - cosine * cosine);
    const double refracted = std::sqrt(std::max(0.0, 1.0 - sine2));
    const double parallel = (cosine - eta * refracted) / (cosine + eta * refracted);
    const double perpendicular = (eta * cosine - refracted) / (eta * cosine + refracted);
    const double reflectance = 0.5 * (parallel * parallel + perpendicular * perpendicular);
    const bool reflects = sine2 >= 1.0 || sampler.next() < reflectance;
    direction = reflects ? direction + 2.0 * cosine * n : eta * direction + (eta * cosine - refracted) * n;
    return reflects ? 1.0 : eta * eta;
}

Vec3 Tracer::radiance(Vec3 origin, Vec3 direction, Sampler& sampler) const
{
    Vec3 sum(0.0), throughput(1.0);
    const Shape* from = nullptr;
    bool count_emission = true;
    for (std::uint32_t vertex = 0;; ++vertex) {
        double t = std::numeric_limits<double>::infinity();
        const Shape* shape = closest(origin, direction, from, t);
        if (!shape) return scene_.environment ? sum + throughput * scene_.environment->radiance : sum;
        origin += t * direction;
        from = shape;
        const Vec3 out = shape->normal_at(origin);
        if (count_emission) sum += throughput * shape->emitted(-dot(out, direction));
        if (vertex == scene_.integrator.max_depth) return sum;

        // Gather light and scatter.
        const bool outside = dot(out, direction) < 0.0;
        const Vec3 n = outside ? out : -out;
        const MaterialDescription& material = scene_.materials[shape->description->material];
        const auto& parameters = material.parameters;
        const std::size_t color = material.bsdf == BSDF_DIELECTRIC ? 1 : 0;
        throughput *= Vec3(parameters[color], parameters[color + 1], parameters[color + 2]);
        count_emission = material.bsdf != BSDF_DIFFUSE || !options_.sample_lights;
        if (!count_emission) sum += throughput * sampled_light(origin, n, from, sampler);
        if (material.bsdf == BSDF_DIFFUSE) direction = normalize(n + unit_sphere_point(sampler.next_2d()));
        if (material.bsdf == BSDF_MIRROR) direction = reflect(direction, n);
        if (material.bsdf == BSDF_DIELECTRIC)
            throughput *= scatter_dielectric(direction, n, outside ? 1.0 / parameters[0] : parameters[0], sampler);

        // Play roulette by throughput.
        if (vertex < options_.roulette_start) continue;
        const double survival = std::min(1.0, std::max({throughput.x, throughput.y, throughput.z}));
        if (!(sampler.next() < survival)) return sum;
        throughput /= survival;
    }
}

std::vector<Vec3> Tracer::render(std::uint32_t batch) const
{
    const auto& [position, look_at, up, vertical_fov, focal_length, location] = scene_.camera;
    const int width = scene_.film.width, height = scene_.film.height;
    const double half_height = std::tan(glm::radians(vertical_fov) / 2.0) * focal_length;
    const Vec3 forward = normalize(look_at - position), right = normalize(cross(forward, up));
    const Vec3 x_axis = right * (half_height * width / height), y_axis = cross(right, forward) * half_height;
    std::seed_seq seed{options_.seed, options_.seed >> 32, std::uint64_t{batch}};
    Sampler sampler{std::mt19937_64(seed)};
    std::vector<Vec3> pixels;
    for (int row = 0; row < height; ++row) {
        for (int column = 0; column < width; ++column) {
            Vec3 sum(0.0);
            for (std::uint32_t i = 0; i < options_.samples_per_batch; ++i) {
                const double x = 2.0 * (column + sampler.next()) / width - 1.0;
                const double y = 1.0 - 2.0 * (row + sampler.next()) / height;
                sum += radiance(position, normalize(forward + x * x_axis + y * y_axis), sampler);
            }
            pixels.push_back(sum / double(options_.samples_per_batch));
        }
    }
    return pixels;
}

// The mean of independent values and the variance of that mean.
std::pair<Vec3, Vec3> mean_and_variance(const std::vector<Vec3>& values)
{
    const double n = static_cast<double>(values.size());
    Vec3 mean(0.0), variance(0.0);
    for (const Vec3& value : values) mean += value / n;
    for (const Vec3& value : values) variance += (value - mean) * (value - mean) / (n * (n - 1.0));
    return {mean, variance};
}
} // namespace

ReferencePicture render_reference(const Scene& scene, const ReferenceOptions& options)
{
    const Tracer tracer(scene, options);
    std::vector<std::vector<Vec3>> batches(options.batches);
    const auto work = [&](std::uint32_t first) {
        for (std::uint32_t i = first; i < options.batches; i += 2) batches[i] = tracer.render(i);
    };
    std::thread second(work, 1);
    work(0);
    second.join();

    ReferencePicture picture;
    std::vector<Vec3> values(options.batches), means(options.batches, Vec3(0.0));
    for (std::size_t pixel = 0; pixel < batches[0].size(); ++pixel) {
        for (std::size_t i = 0; i < values.size(); ++i) {
            values[i] = batches[i][pixel];
            means[i] += values[i] / static_cast<double>(batches[0].size());
        }
        const auto [mean, variance] = mean_and_variance(values);
        picture.pixels.push_back(mean);
        picture.pixel_variances.push_back(variance);
    }
    const auto [mean, variance] = mean_and_variance(means);
    picture.mean = mean;
    picture.standard_error = sqrt(variance);
    return picture;
}
} // namespace etendue
