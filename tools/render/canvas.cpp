#include "render/canvas.hpp"

#include <cairo-svg.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <stdexcept>
#include <utility>

namespace laneloom::render {
namespace {

constexpr double kPngScale = 2.0;        ///< pixels of a PNG per unit: sharp in print
constexpr double kMostPixels = 32767.0;  ///< of a side of an image of cairo

cairo_surface_t* make_image(double width, double height) {
  const double columns = std::ceil(width * kPngScale), rows = std::ceil(height * kPngScale);
  if (std::max(columns, rows) > kMostPixels)
    throw std::runtime_error(
        fmt::format("the picture would have {:.0f} x {:.0f} pixels, and {:.0f} a side are the most: draw "
                    "fewer moments, a smaller range, or an .svg",
                    columns, rows, kMostPixels));
  return cairo_image_surface_create(CAIRO_FORMAT_ARGB32, static_cast<int>(columns), static_cast<int>(rows));
}

cairo_surface_t* make_surface(const std::string& path, double width, double height) {
  if (path.ends_with(".png")) return make_image(width, height);
  if (path.ends_with(".svg")) return cairo_svg_surface_create(path.c_str(), width, height);
  throw std::runtime_error(path + ": pictures are .png or .svg");
}

cairo_status_t append(void* text, const unsigned char* bytes, unsigned size) {
  static_cast<std::string*>(text)->append(bytes, bytes + size);
  return CAIRO_STATUS_SUCCESS;
}

void check(const std::string& path, cairo_status_t status) {
  if (status != CAIRO_STATUS_SUCCESS) throw std::runtime_error(path + ": " + cairo_status_to_string(status));
}

}  // namespace

Canvas::Canvas(const std::string& path, bool is_png, cairo_surface_t* surface,
               std::unique_ptr<std::string> memory)
    : path_(path),
      is_png_(is_png),
      memory_(std::move(memory)),
      surface_(surface, cairo_surface_destroy),
      cairo_(cairo_create(surface_.get()), cairo_destroy) {
  if (is_png_) cairo_scale(cairo_.get(), kPngScale, kPngScale);
  cairo_set_line_join(cairo_.get(), CAIRO_LINE_JOIN_ROUND);
}

Canvas::Canvas(const std::string& path, double width, double height)
    : Canvas(path, path.ends_with(".png"), make_surface(path, width, height), nullptr) {
  fill(rectangle({0, 0}, {width, height}), {1, 1, 1});
}

Canvas Canvas::in_memory(bool svg, double width, double height) {
  auto memory = std::make_unique<std::string>();
  cairo_surface_t* surface = svg ? cairo_svg_surface_create_for_stream(append, memory.get(), width, height)
                                 : make_image(width, height);
  Canvas canvas("", !svg, surface, std::move(memory));
  canvas.fill(rectangle({0, 0}, {width, height}), {1, 1, 1});
  return canvas;
}

void Canvas::stroke(const Outline& line, const Pen& pen) {
  use(pen.colour);
  cairo_set_line_width(cairo_.get(), pen.width);
  cairo_set_dash(cairo_.get(), pen.dashes.data(), static_cast<int>(pen.dashes.size()), 0.0);
  trace(line);
  cairo_stroke(cairo_.get());
}

void Canvas::fill(const Outline& polygon, const drawing::Colour& colour) {
  use(colour);
  trace(polygon);
  cairo_close_path(cairo_.get());
  cairo_fill(cairo_.get());
}

void Canvas::text(const Pixel& position, const std::string& text, double size, const drawing::Colour& colour,
                  Align align, bool bold) {
  use(colour);
  cairo_select_font_face(cairo_.get(), "DejaVu Sans", CAIRO_FONT_SLANT_NORMAL,
                         bold ? CAIRO_FONT_WEIGHT_BOLD : CAIRO_FONT_WEIGHT_NORMAL);
  cairo_set_font_size(cairo_.get(), size);
  cairo_text_extents_t extents;
  cairo_text_extents(cairo_.get(), text.c_str(), &extents);
  const double shift = align == Align::left ? 0.0 : align == Align::right ? 1.0 : 0.5;
  cairo_move_to(cairo_.get(), position.x() - shift * extents.x_advance, position.y());
  cairo_show_text(cairo_.get(), text.c_str());
}

void Canvas::clip(const Pixel& top_left, const Pixel& size) {
  cairo_save(cairo_.get());
  cairo_rectangle(cairo_.get(), top_left.x(), top_left.y(), size.x(), size.y());
  cairo_clip(cairo_.get());
}

void Canvas::unclip() { cairo_restore(cairo_.get()); }

void Canvas::finish() {
  check(path_, cairo_status(cairo_.get()));
  if (is_png_ && memory_) return cairo_surface_flush(surface_.get());
  if (is_png_) check(path_, cairo_surface_write_to_png(surface_.get(), path_.c_str()));
  cairo_surface_finish(surface_.get());
  check(path_, cairo_surface_status(surface_.get()));
}

Image Canvas::image() const {
  const int width = cairo_image_surface_get_width(surface_.get());
  const int height = cairo_image_surface_get_height(surface_.get());
  const int stride = cairo_image_surface_get_stride(surface_.get());
  const unsigned char* const bytes = cairo_image_surface_get_data(surface_.get());
  Image image{static_cast<std::size_t>(width), static_cast<std::size_t>(height), {}};
  image.rgb.reserve(3 * image.width * image.height);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      std::uint32_t pixel = 0;  // 0xAARRGGBB in the host's order of bytes
      std::memcpy(&pixel, bytes + static_cast<std::ptrdiff_t>(y) * stride + 4 * x, sizeof(pixel));
      for (const unsigned shift : {16U, 8U, 0U})
        image.rgb.push_back(static_cast<std::uint8_t>(pixel >> shift));
    }
  return image;
}

void Canvas::trace(const Outline& outline) {
  cairo_new_path(cairo_.get());
  for (const Pixel& pixel : outline) cairo_line_to(cairo_.get(), pixel.x(), pixel.y());
}

void Canvas::use(const drawing::Colour& colour) {
  cairo_set_source_rgba(cairo_.get(), colour.red, colour.green, colour.blue, colour.alpha);
}

Outline rectangle(const Pixel& top_left, const Pixel& size) {
  const Pixel bottom_right = top_left + size;
  return {
      top_left, {bottom_right.x(), top_left.y()}, bottom_right, {top_left.x(), bottom_right.y()}, top_left};
}

}  // namespace laneloom::render
