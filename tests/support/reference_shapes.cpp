// Shapes of a scene to triangles, disks and spheres in world space.
#include "support/reference_shapes.h"

#include "geometry/mesh_io.h"

#include <cmath>
#include <limits>
#include <numbers>

namespace etendue
{
using std::numbers::pi;

namespace
{
Mesh as_mesh(const ShapeDescription& shape, const std::string& folder)
{
    if (const auto* file = std::get_if<MeshFile>(&shape.geometry))
        return read_mesh(file->file.starts_with('/') ? file->file : folder + "/" + file->file);
    Mesh mesh;
    if (const auto* triangles = std::get_if<InlineTriangles>(&shape.geometry)) {
        mesh.positions = triangles->positions, mesh.normals = triangles->normals, mesh.indices = triangles->indices;
    } else if (const auto* rectangle = std::get_if<RectangleShape>(&shape.geometry)) {
        for (const Vec2 corner : {Vec2(-0.5, -0.5), Vec2(0.5, -0.5), Vec2(0.5, 0.5), Vec2(-0.5, 0.5)})
            mesh.positions.emplace_back(corner * rectangle->size, 0.0);
        mesh.indices = {{0, 1, 2}, {0, 2, 3}};
    } else {
        for (unsigned i = 0; i < 8; ++i)
            mesh.positions.push_back((Vec3(i & 1, i >> 1 & 1, i >> 2) - 0.5) * std::get<BoxShape>(shape.geometry).size);
        mesh.normals = mesh.positions; // outward is away from the centre, whatever the winding
        mesh.indices = {{0, 1, 3}, {0, 3, 2}, {4, 5, 7}, {4, 7, 6}, {0, 1, 5}, {0, 5, 4},
                        {2, 3, 7}, {2, 7, 6}, {0, 2, 6}, {0, 6, 4}, {1, 3, 7}, {1, 7, 5}};
    }
    return mesh;
}

void append(std::vector<ReferenceShape>& shapes, const ShapeDescription& shape, const std::string& folder)
{
    const auto place = [&](const Vec3& p) { return Vec3(shape.transform * Vec4(p, 1.0)); };
    const double determinant = glm::determinant(glm::dmat3(shape.transform));
    const double scale = std::cbrt(std::abs(determinant)), side = shape.flip_normals ? -1.0 : 1.0;
    if (const auto* sphere = std::get_if<SphereShape>(&shape.geometry)) {
        const double r = sphere->radius * scale;
        shapes.push_back({ReferenceShape::Kind::sphere, &shape, place({}), {}, {}, {}, r, 4.0 * pi * r * r});
    } else if (const auto* disk = std::get_if<DiskShape>(&shape.geometry)) {
        const double r = disk->radius * scale;
        const Vec3 normal = side * normalize(Vec3(shape.transform[2]));
        shapes.push_back({ReferenceShape::Kind::disk, &shape, place({}), {}, {}, normal, r, pi * r * r});
    } else {
        const Mesh mesh = as_mesh(shape, folder);
        for (std::size_t i = 0; i < mesh.indices.size(); ++i) {
            const Vec3 a = mesh.positions[mesh.indices[i].x], b = mesh.positions[mesh.indices[i].y],
                       c = mesh.positions[mesh.indices[i].z];
            // The vertex normals, where there are any, tell which side is out; else the winding does.
            double out = determinant < 0.0 ? -side : side;
            if (const glm::u32vec3 n = mesh.normals_of(i); n.x != NO_INDEX)
                out *= dot(cross(b - a, c - a), mesh.normals[n.x] + mesh.normals[n.y] + mesh.normals[n.z]) < 0 ? -1 : 1;
            const Vec3 edge1 = place(b) - place(a), edge2 = place(c) - place(a), n = cross(edge1, edge2);
            shapes.push_back(
                {ReferenceShape::Kind::triangle, &shape, place(a), edge1, edge2, normalize(n) * out, 0, length(n) / 2});
        }
    }
}
} // namespace

Vec3 ReferenceShape::normal_at(const Vec3& p) const
{
    if (kind != Kind::sphere) return normal;
    return (p - a) * ((description->flip_normals ? -1.0 : 1.0) / radius);
}

Vec3 ReferenceShape::emitted(double cosine) const
{
    const auto& emission = description->emission;
    return emission && (emission->two_sided || cosine > 0.0) ? emission->radiance : Vec3(0.0);
}

Vec3 ReferenceShape::sample_point(const Vec2& u) const
{
    if (kind == Kind::sphere) return a + radius * unit_sphere_point(u);
    const double root = std::sqrt(u.x);
    if (kind == Kind::triangle) return a + root * ((1.0 - u.y) * edge1 + u.y * edge2);
    const Vec3 x = normalize(cross(normal, std::abs(normal.x) < 0.5 ? Vec3(1, 0, 0) : Vec3(0, 1, 0)));
    return a + radius * root * (std::cos(2.0 * pi * u.y) * x + std::sin(2.0 * pi * u.y) * cross(normal, x));
}

double ReferenceShape::intersect(const Vec3& origin, const Vec3& direction, double least) const
{
    constexpr double MISS = std::numeric_limits<double>::infinity();
    const Vec3 s = origin - a;
    if (kind == Kind::triangle) {
        // T. Moeller and B. Trumbore, Fast, Minimum Storage Ray/Triangle Intersection (1997).
        const Vec3 p = cross(direction, edge2);
        const Vec3 q = cross(s, edge1);
        const double inverse = 1.0 / dot(edge1, p);
        const double u = dot(s, p) * inverse;
        const double v = dot(direction, q) * inverse;
        return u >= 0.0 && v >= 0.0 && u + v <= 1.0 ? dot(edge2, q) * inverse : MISS;
    }
    if (kind == Kind::disk) {
        const double t = -dot(s, normal) / dot(direction, normal);
        return length(s + t * direction) <= radius ? t : MISS;
    }
    const double middle = -dot(s, direction);
    const double height = length(s + middle * direction);
    if (height > radius) return MISS;
    const double half = std::sqrt((radius - height) * (radius + height));
    return middle - half > least ? middle - half : middle + half;
}

Vec3 unit_sphere_point(const Vec2& u)
{
    const double z = 1.0 - 2.0 * u.x;
    const double r = std::sqrt(1.0 - z * z);
    return {r * std::cos(2.0 * pi * u.y), r * std::sin(2.0 * pi * u.y), z};
}

std::vector<ReferenceShape> make_reference_shapes(const Scene& scene)
{
    std::vector<ReferenceShape> shapes;
    for (const ShapeDescription& shape : scene.shapes) append(shapes, shape, scene.folder);
    return shapes;
}
} // namespace etendue
