#include "render/canvas.hpp"

#include <cairo-svg.h>

#include <cmath>
#include <stdexcept>

namespace laneloom::render {
namespace {

constexpr double kPngScale = 2.0;  ///< pixels of a PNG per unit: sharp in print

cairo_surface_t* make_surface(const std::string& path, double width, double height) {
  if (path.ends_with(".png"))
    return cairo_image_surface_create(CAIRO_FORMAT_ARGB32, static_cast<int>(std::ceil(width * kPngScale)),
                                      static_cast<int>(std::ceil(height * kPngScale)));
  if (path.ends_with(".svg")) return cairo_svg_surface_create(path.c_str(), width, height);
  throw std::runtime_error(path + ": pictures are .png or .svg");
}

void check(const std::string& path, cairo_status_t status) {
  if (status != CAIRO_STATUS_SUCCESS) throw std::runtime_error(path + ": " + cairo_status_to_string(status));
}

}  // namespace

Canvas::Canvas(const std::string& path, double width, double height)
    : path_(path),
      is_png_(path.ends_with(".png")),
      surface_(make_surface(path, width, height), cairo_surface_destroy),
      cairo_(cairo_create(surface_.get()), cairo_destroy) {
  if (is_png_) cairo_scale(cairo_.get(), kPngScale, kPngScale);
  cairo_set_line_join(cairo_.get(), CAIRO_LINE_JOIN_ROUND);
  fill(rectangle({0, 0}, {width, height}), {1, 1, 1});
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
  if (is_png_) check(path_, cairo_surface_write_to_png(surface_.get(), path_.c_str()));
  cairo_surface_finish(surface_.get());
  check(path_, cairo_surface_status(surface_.get()));
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
