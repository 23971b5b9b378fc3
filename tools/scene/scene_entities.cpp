#include "scene/scene_entities.hpp"

#include <algorithm>
#include <optional>

#include "laneloom/element_names.hpp"
#include "laneloom/polyline.hpp"
#include "scene/triangles.hpp"

namespace laneloom::scene {
namespace {

using foxglove::LineType;
using foxglove::SceneEntity;

constexpr double kLayerStep_m = 0.02;        ///< by so much a shape that is painted later lies higher
constexpr double kDashMetresPerPixel = 0.2;  ///< a dash is painted as long as a real one, about
constexpr double kMostDashes = 500;          ///< of a line; they would not fit in a view of any use
constexpr double kArrowMetresPerPixel = 0.1;
constexpr double kOutlineWidth_px = 1.5;  ///< of an area that is not filled

/// The dashes of a line, as segments. None: it would have too many.
std::optional<Polyline> dashes(const Polyline& points, const drawing::palette::StyleSpec& spec) {
  const MeasuredPolyline line(points);
  Polyline segments;
  const double on_m = spec.dash_on * kDashMetresPerPixel, off_m = spec.dash_off * kDashMetresPerPixel;
  if (line.length() > kMostDashes * (on_m + off_m)) return std::nullopt;
  for (double from_m = 0.0; from_m < line.length(); from_m += on_m + off_m) {
    const Polyline dash = line.slice({from_m, std::min(from_m + on_m, line.length())});
    for (std::size_t i = 1; i < dash.size(); ++i) segments.insert(segments.end(), {dash[i - 1], dash[i]});
  }
  return segments;
}

/// Makes an element's shapes into primitives.
class Shaper {
 public:
  Shaper(drawing::Layer layer, const Point& origin, SceneEntity& to)
      : overlay_(drawing::palette::of(layer).overlay),
        origin_(origin),
        lift_(0.0, 0.0, kLayerStep_m * static_cast<double>(layer)),
        to_(to) {}

  void add(const drawing::Shape& shape) {
    std::visit([&](const auto& form) { add(form, shape); }, shape.form);
  }

 private:
  static drawing::Colour colour_of(const drawing::Shape& shape) {
    return drawing::palette::of(shape.style).dark.faded(shape.opacity);
  }

  Polyline relative(const Polyline& points) const {
    Polyline out;
    out.reserve(points.size());
    for (const Point& point : points) out.emplace_back(point - origin_);
    return out;
  }
  void add_line(LineType type, double width_px, const Polyline& points, const drawing::Shape& shape) {
    to_.lines.push_back({type, origin_ + lift_, width_px, relative(points), colour_of(shape)});
  }
  void add_triangles(const Polyline& points, std::vector<std::uint32_t> indices,
                     const drawing::Shape& shape) {
    to_.triangles.push_back({origin_ + lift_, relative(points), colour_of(shape), std::move(indices)});
  }

  void add(const drawing::DrawnLine& line, const drawing::Shape& shape) {
    const drawing::palette::StyleSpec& spec = drawing::palette::of(shape.style);
    const auto segments = spec.dash_on > 0.0 ? dashes(line.points, spec) : std::nullopt;
    if (segments)
      add_line(LineType::list, overlay_ * spec.width, *segments, shape);
    else
      add_line(LineType::strip, overlay_ * spec.width, line.points, shape);
  }
  void add(const drawing::DrawnArea& area, const drawing::Shape& shape) {
    Polyline points = area.left;
    points.insert(points.end(), area.right.begin(), area.right.end());
    auto triangles =
        area.right.empty() ? convex_triangles(area.left) : strip_triangles(area.left, area.right);
    if (triangles.empty())
      add_line(LineType::loop, kOutlineWidth_px, points, shape);
    else
      add_triangles(points, std::move(triangles), shape);
  }
  void add(const drawing::DrawnArrow& arrow, const drawing::Shape& shape) {
    const Point along = kArrowMetresPerPixel * drawing::palette::of(shape.style).head * arrow.direction;
    const Point across = 0.45 * Point(-along.y(), along.x(), 0.0);
    const Point back = arrow.tip - along;
    add_triangles({arrow.tip, back + across, back - across}, {0, 1, 2}, shape);
  }
  void add(const drawing::DrawnText& text, const drawing::Shape& shape) {
    to_.texts.push_back(
        {text.position + lift_, drawing::palette::of(shape.style).text, colour_of(shape), text.text});
  }

  double overlay_;
  Point origin_, lift_;
  SceneEntity& to_;
};

std::vector<std::pair<std::string, std::string>> metadata_of(const drawing::Element& element) {
  std::vector<std::pair<std::string, std::string>> out{{"layer", drawing::palette::of(element.layer).name},
                                                       {"type", element.type}};
  if (element.id != kNoElement) out.emplace_back("id", std::to_string(element.id));
  if (element.status) out.emplace_back("status", name(*element.status));
  for (const auto& [key, value] : element.properties.items())
    out.emplace_back(key, value.is_string() ? value.get<std::string>() : value.dump());
  return out;
}

}  // namespace

void append_entities(const drawing::Drawing& drawing, const SceneFrame& frame, std::vector<SceneEntity>& to) {
  const Point origin = drawing.T_map_body.translation().array().round();
  for (const drawing::Element& element : drawing.elements()) {
    SceneEntity& entity = to.emplace_back();
    entity.frame_id = frame.id;
    entity.id = element.key;
    entity.frame_locked = frame.locked;
    entity.metadata = metadata_of(element);
    Shaper shaper(element.layer, origin, entity);
    for (const drawing::Shape& shape : element.shapes) shaper.add(shape);
  }
}

}  // namespace laneloom::scene
