#pragma once

#include <cairo.h>

#include <Eigen/Core>
#include <memory>
#include <string>
#include <vector>

#include "drawing/colour.hpp"
#include "render/image.hpp"

namespace laneloom::render {

using Pixel = Eigen::Vector2d;
using Outline = std::vector<Pixel>;

/// Colour, width (pixels) and dashes of a stroke.
struct Pen {
  drawing::Colour colour;
  double width = 1.0;
  std::vector<double> dashes;  ///< on, off, on, … in pixels; empty: solid
};

enum class Align { left, centre, right };

/// A sheet to draw on: x right, y down, in pixels of a screen. The file's extension tells whether it is PNG
/// or SVG; both have the same strokes.
class Canvas {
 public:
  /// Throws std::runtime_error for an extension other than ".png" and ".svg".
  Canvas(const std::string& path, double width, double height);
  /// A sheet that is kept in memory: pixels, or with `svg` SVG.
  static Canvas in_memory(bool svg, double width, double height);

  void stroke(const Outline& line, const Pen& pen);
  void fill(const Outline& polygon, const drawing::Colour& colour);
  /// `position` is the baseline's left end, middle or right end.
  void text(const Pixel& position, const std::string& text, double size, const drawing::Colour& colour,
            Align align = Align::left, bool bold = false);
  /// Limits drawing to the rectangle, until unclip().
  void clip(const Pixel& top_left, const Pixel& size);
  void unclip();

  /// Writes the file. Throws std::runtime_error if that fails.
  void finish();
  /// The sheet in memory, once it is finished: its pixels, at twice the size.
  Image image() const;
  /// Likewise as SVG.
  const std::string& svg() const { return *memory_; }

 private:
  Canvas(const std::string& path, bool is_png, cairo_surface_t* surface, std::unique_ptr<std::string> memory);
  void trace(const Outline& outline);
  void use(const drawing::Colour& colour);

  std::string path_;
  bool is_png_;
  std::unique_ptr<std::string> memory_;  ///< of SVG; null: the sheet is a file
  std::unique_ptr<cairo_surface_t, decltype(&cairo_surface_destroy)> surface_;
  std::unique_ptr<cairo_t, decltype(&cairo_destroy)> cairo_;
};

Outline rectangle(const Pixel& top_left, const Pixel& size);

}  // namespace laneloom::render
