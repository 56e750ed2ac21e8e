// SVG to PNG by librsvg and cairo.
#include "image/plot.h"

#include "util/error.h"

#include <cmath>
#include <memory>

#include <cairo.h>
#include <fmt/format.h>
#include <librsvg/rsvg.h>

namespace etendue
{
namespace
{
constexpr int MAX_SIZE = 16384; // pixels: cairo has 32767

struct Release {
    void operator()(RsvgHandle* handle) const { g_object_unref(handle); }
    void operator()(cairo_surface_t* surface) const { cairo_surface_destroy(surface); }
    void operator()(cairo_t* context) const { cairo_destroy(context); }
    void operator()(GError* error) const { g_error_free(error); }
};
template<typename T>
using Owned = std::unique_ptr<T, Release>;

// A drawing that cannot be made is a fault of this program, not of a file.
[[noreturn]] void fail(const std::string& what, GError* error)
{
    const Owned<GError> owned(error);
    throw Error(fmt::format("A drawing cannot be made into a picture: {}{}{}.", what, error ? ": " : "",
                            error ? error->message : ""),
                ExitCode::check);
}

cairo_status_t append(void* bytes, const unsigned char* data, unsigned int length)
{
    static_cast<std::string*>(bytes)->append(reinterpret_cast<const char*>(data), length);
    return CAIRO_STATUS_SUCCESS;
}
} // namespace

std::string svg_png(const std::string& svg, double scale)
{
    GError* error = nullptr;
    const auto* const data = reinterpret_cast<const guint8*>(svg.data());
    const Owned<RsvgHandle> handle(rsvg_handle_new_from_data(data, svg.size(), &error));
    if (!handle) fail("it is not well-formed", error);

    double width = 0.0, height = 0.0;
    if (!rsvg_handle_get_intrinsic_size_in_pixels(handle.get(), &width, &height)) fail("it has no size", nullptr);
    const int columns = static_cast<int>(std::lround(width * scale)),
              rows = static_cast<int>(std::lround(height * scale));
    if (columns < 1 || rows < 1 || columns > MAX_SIZE || rows > MAX_SIZE)
        fail(fmt::format("it has {}x{} pixels", columns, rows), nullptr);

    const Owned<cairo_surface_t> surface(cairo_image_surface_create(CAIRO_FORMAT_ARGB32, columns, rows));
    const Owned<cairo_t> context(cairo_create(surface.get()));
    const RsvgRectangle viewport{0.0, 0.0, static_cast<double>(columns), static_cast<double>(rows)};
    if (!rsvg_handle_render_document(handle.get(), context.get(), &viewport, &error)) fail("it cannot be drawn", error);

    std::string bytes;
    if (cairo_surface_write_to_png_stream(surface.get(), append, &bytes) != CAIRO_STATUS_SUCCESS)
        fail("it cannot be encoded", nullptr);
    return bytes;
}
} // namespace etendue
