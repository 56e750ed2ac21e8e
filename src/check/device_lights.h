// Lights on a device: samples of them, and what rays that meet them see.
#pragma once

#include "check/device_functions.h"
#include "check/random_words.h"
#include "compute/device.h"
#include "math/shared.h"

#include <array>
#include <string>
#include <vector>

namespace etendue
{
using Point = std::array<double, 3>;

Point operator-(const Point& a, const Point& b);
Point operator+(const Point& a, const Point& b);
Point operator*(double s, const Point& a);
double dot(const Point& a, const Point& b);
Point cross(const Point& a, const Point& b);
double length(const Point& a);
Point unit(const Point& a);

// Two unit vectors that complete a unit vector to a right-handed frame.
std::array<Point, 2> complete_frame(const Point& n);

// Point i of a sequence that covers the unit square evenly (M. Roberts 2018: multiples of powers of the plastic
// number).
std::array<double, 2> even_point(std::size_t i);

// The 32 bits that uniform_float() turns into u.
uint random_word(double u);

// Lights and the primitives that they are.
struct LightScene {
    std::vector<Primitive> primitives;
    std::vector<PrimitiveSurface> surfaces;
    std::vector<Light> lights;

    // Add a primitive that emits, with a weight for its choice.
    void add_area(const Primitive& primitive, const Point& radiance, double weight = 1, uint light_flags = 0,
                  uint surface_flags = 0);
    // A primitive that emits nothing.
    void add_dark(const Primitive& primitive);
    void add_environment(const Point& radiance, double weight = 1);
};

struct DeviceLightSample {
    Point wi, to_light, radiance;
    double t_max, pdf;
    uint primitive;
};

struct DeviceLightHit {
    uint primitive; // NO_INDEX: nothing was met
    Point radiance;
    double pdf; // of light_sample from the ray's origin, per solid angle
};

// The lights of a scene on a device.
class DeviceLights
{
public:
    // Turns the weights into an alias table and probabilities; spheres are sampled by area where that is asked for.
    DeviceLights(const Device& device, LightScene scene, std::uint32_t lanes = 0, bool sphere_area = false);

    // The probability that the table gives each light.
    const std::vector<double>& probabilities() const { return probabilities_; }

    // light_sample of all active lanes from a point.
    std::vector<DeviceLightSample> sample(const Point& from, const std::vector<std::array<uint, 4>>& random) const;
    std::vector<DeviceLightSample> sample(const Point& from, const std::vector<std::array<uint, 4>>& random,
                                          const std::vector<uint>& active) const;

    // What rays from one point see: light_hit of the nearest primitive, or light_escape.
    std::vector<DeviceLightHit> meet(const Point& from, const std::vector<Point>& directions) const;

private:
    const Device& device_;
    std::uint32_t lanes_;
    LightScene scene_;
    std::vector<AliasBucket> table_;
    std::vector<double> probabilities_;
    RenderSettings settings_{};
};

// Random words of samples that cover a light's two dimensions evenly; the choice of the light is random.
std::vector<std::array<uint, 4>> even_words(std::size_t count);
} // namespace etendue
