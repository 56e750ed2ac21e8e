// Closed forms from J. R. Howell, A Catalog of Radiation Heat Transfer Configuration Factors, differential element to
// finite area.
#include "support/form_factors.h"

#include <cmath>
#include <numbers>

namespace etendue
{
using std::numbers::pi;

namespace
{
// The part of a polygon, relative to the patch, above its horizon.
std::vector<Vec3> clip_to_horizon(const Vec3& p, const Vec3& n, const std::vector<Vec3>& vertices)
{
    std::vector<Vec3> clipped;
    for (std::size_t i = 0; i < vertices.size(); ++i) {
        const Vec3 v = vertices[i] - p;
        const Vec3 next = vertices[(i + 1) % vertices.size()] - p;
        const double height = dot(v, n);
        const double next_height = dot(next, n);
        if (height >= 0.0) clipped.push_back(v);
        if ((height < 0.0) != (next_height < 0.0))
            clipped.push_back(v + (next - v) * (height / (height - next_height)));
    }
    return clipped;
}
} // namespace

double polygon_form_factor(const Vec3& p, const Vec3& n, const std::vector<Vec3>& vertices)
{
    const std::vector<Vec3> polygon = clip_to_horizon(p, n, vertices);
    double sum = 0.0;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
        const Vec3& v = polygon[i];
        const Vec3& next = polygon[(i + 1) % polygon.size()];
        const Vec3 normal = cross(v, next);
        const double sine = length(normal);
        // An edge in line with the patch spans no angle.
        if (sine > 0.0) sum += std::atan2(sine, dot(v, next)) * dot(normal, n) / sine;
    }
    return std::abs(sum) / (2.0 * pi);
}

double parallel_rectangle_form_factor(double a, double b, double c)
{
    const double x = std::hypot(1.0, a / c);
    const double y = std::hypot(1.0, b / c);
    return (a / c / x * std::atan(b / c / x) + b / c / y * std::atan(a / c / y)) / (2.0 * pi);
}

double perpendicular_rectangle_form_factor(double a, double b, double c)
{
    const double diagonal = std::hypot(a, c);
    return (std::atan(b / c) - c / diagonal * std::atan(b / diagonal)) / (2.0 * pi);
}

double disk_form_factor(double radius, double h, double offset)
{
    // The catalogue's 1/2 (1 - (z - 2 r^2) / root), as a product: exact on the axis and for small disks.
    const double z = offset * offset + h * h + radius * radius;
    const double root = std::sqrt(z * z - 4.0 * radius * radius * offset * offset);
    return 2.0 * radius * radius * h * h / (root * (root + z - 2.0 * radius * radius));
}

double sphere_form_factor(double radius, double distance, double theta)
{
    const double h = distance / radius;
    const double c = std::cos(theta);
    if (h * c >= 1.0) return c / (h * h);
    if (h * c <= -1.0) return 0.0;
    const double q = std::sqrt(h * h - 1.0);
    const double visible = std::sqrt(1.0 - h * h * c * c);
    return (c * std::acos(-q * c / std::sin(theta)) - q * visible) / (pi * h * h) + std::atan(visible / q) / pi;
}
} // namespace etendue
