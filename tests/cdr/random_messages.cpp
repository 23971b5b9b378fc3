#include "cdr/random_messages.hpp"

namespace laneloom::dds {

std::vector<double> RandomMessages::numbers(std::size_t count) {
  std::vector<double> list(count);
  for (auto& value : list) value = number();
  return list;
}

msg::Point RandomMessages::point() {
  msg::Point m;
  m.x(number());
  m.y(number());
  m.z(number());
  return m;
}

msg::Range RandomMessages::range() {
  msg::Range m;
  m.from_m(number());
  m.to_m(number());
  return m;
}

msg::Pose RandomMessages::pose() {
  msg::Pose m;
  m.position(point());
  // One of the rotations that survive any way of writing them down to the last bit.
  m.orientation().x(0.5);
  m.orientation().y(-0.5);
  m.orientation().z(0.5);
  m.orientation().w(0.5);
  return m;
}

msg::Header RandomMessages::header() {
  msg::Header m;
  m.stamp_ns(stamp());
  m.sequence_number(id());
  m.session_id(id());
  m.frame_id(text("frame").c_str());
  return m;
}

msg::Marking RandomMessages::marking() {
  msg::Marking m;
  m.id(id());
  m.type(one_of(msg::MarkingType::STOPLINE));
  m.status(one_of(msg::ElementStatus::STATUS_INFERRED));
  m.points(polyline());
  m.styles(several(5, [&] {
    msg::StyleRange style;
    style.range(range());
    style.style(one_of(msg::MarkingStyle::STYLE_DASHED));
    return style;
  }));
  m.lateral_stddev_m(numbers(m.points().size()));
  m.existence_probability(number());
  m.observations(id());
  m.age_s(age());
  m.unseen_s(age());
  return m;
}

msg::Neighbour RandomMessages::neighbour() {
  msg::Neighbour m;
  m.lane(id());
  m.range(range());
  m.crossable(several(3, [&] { return range(); }));
  return m;
}

msg::Border RandomMessages::border() {
  msg::Border m;
  m.boundary(id());
  m.range(range());
  m.on_boundary(range());
  return m;
}

msg::Lane RandomMessages::lane() {
  msg::Lane m;
  m.id(id());
  m.left_borders(several(3, [&] { return border(); }));
  m.right_borders(several(3, [&] { return border(); }));
  m.left(polyline());
  m.right(polyline());
  m.centerline(polyline());
  m.width_m(number());
  m.left_neighbours(several(3, [&] { return neighbour(); }));
  m.right_neighbours(several(3, [&] { return neighbour(); }));
  m.direction(one_of(msg::DrivingDirection::DIRECTION_BOTH));
  m.direction_probability(number());
  m.direction_evidence(evidence());
  m.use(one_of(msg::LaneUse::USE_CYCLE));
  m.use_probability(number());
  m.section(static_cast<std::uint32_t>(whole(1000)));
  m.status(one_of(msg::ElementStatus::STATUS_INFERRED));
  m.existence_probability(number());
  m.evidence(evidence());
  m.inferred_ranges(several(4, [&] { return range(); }));
  return m;
}

msg::Stopline RandomMessages::stopline() {
  msg::Stopline m;
  m.marking(marking());
  m.lanes(several(4, [&] { return id(); }));
  m.heading(point());
  return m;
}

msg::Linkage RandomMessages::linkage() {
  msg::Linkage m;
  m.from_lane(id());
  m.to_lane(id());
  m.kind(one_of(msg::LinkageKind::LINKAGE_TRAFFIC));
  m.turn(one_of(msg::TurnKind::TURN_U));
  m.probability(number());
  m.evidence(evidence());
  m.path(polyline());
  return m;
}

msg::WayStation RandomMessages::way_station() {
  msg::WayStation m;
  m.point(point());
  m.heading_rad(number());
  m.curvature_per_m(number());
  m.lane(id());
  m.left_m(number());
  m.right_m(number());
  m.width_m(number());
  m.lateral_stddev_m(number());
  m.status(one_of(msg::ElementStatus::STATUS_INFERRED));
  m.may_change_left(whole(2) == 1);
  m.may_change_right(whole(2) == 1);
  return m;
}

msg::Way RandomMessages::way() {
  msg::Way m;
  m.step_m(0.5);
  m.stations(several(3, [&] { return way_station(); }));
  m.stations().push_back(way_station());  // two at least
  m.lanes(several(3, [&] {
    msg::WayLane lane;
    lane.lane(id());
    lane.against(whole(2) == 1);
    lane.entry(one_of(msg::TurnKind::TURN_U));
    lane.range(range());
    return lane;
  }));
  m.known_m(number());
  m.confirmed_m(number());
  return m;
}

msg::Detections RandomMessages::detections() {
  msg::Detections m;
  m.header(header());
  m.source(text("source").c_str());
  m.detected_types(several(3, [&] { return one_of(msg::MarkingType::STOPLINE); }));
  m.field_of_view(polyline());
  m.occluded_areas(several(4, [&] {
    msg::Area area;
    area.outline(polyline());
    return area;
  }));
  m.detections(several(6, [&] {
    msg::Detection detection;
    detection.type(one_of(msg::MarkingType::STOPLINE));
    detection.style(one_of(msg::MarkingStyle::STYLE_DASHED));
    detection.confidence(number());
    detection.points(polyline());
    detection.stddev_m(numbers(detection.points().size()));
    return detection;
  }));
  return m;
}

msg::VehiclePose RandomMessages::vehicle_pose() {
  msg::VehiclePose m;
  m.header(header());
  m.pose(pose());
  m.covariance(numbers(36));
  return m;
}

msg::NextTurn RandomMessages::next_turn() {
  msg::NextTurn m;
  m.header(header());
  m.turn(one_of(msg::TurnKind::TURN_U));
  m.distance_m(number());
  return m;
}

msg::Objects RandomMessages::objects() {
  msg::Objects m;
  m.header(header());
  m.objects(several(5, [&] {
    msg::TrackedObject object;
    object.id(id());
    object.kind(one_of(msg::ObjectKind::OBJECT_PEDESTRIAN));
    object.existence_probability(number());
    object.position(point());
    object.heading(point());
    object.speed_mps(number());
    object.position_stddev_m(number());
    object.length_m(number());
    object.width_m(number());
    return object;
  }));
  return m;
}

msg::LaneMap RandomMessages::lane_map() {
  msg::LaneMap m;
  m.header(header());
  m.published_ns(stamp());
  m.map_id(id());
  m.age_s(number());
  m.lag_s(number());
  m.state(one_of(msg::MapState::MAP_STALE));
  m.reasons(several(3, [&] { return one_of(msg::StateReason::REASON_DRIVING_SIDE_CONTRADICTED); }));
  m.pose(pose());
  m.fused_frames(several(4, [&] {
    msg::FusedFrame frame;
    frame.source(text("camera").c_str());
    frame.session_id(id());
    frame.sequence_number(id());
    frame.stamp_ns(stamp());
    return frame;
  }));
  m.boundaries(several(5, [&] { return marking(); }));
  m.lanes(several(4, [&] { return lane(); }));
  m.stoplines(several(3, [&] { return stopline(); }));
  m.linkages(several(4, [&] { return linkage(); }));
  m.way(way());
  m.driven_paths(several(3, [&] {
    msg::DrivenPath path;
    path.id(id());
    path.points(polyline());
    path.lateral_stddev_m(number());
    path.probability(number());
    return path;
  }));
  m.lineage(several(4, [&] {
    msg::LineageEvent event;
    event.kind(one_of(msg::LineageKind::LINEAGE_RETIRED));
    event.element(one_of(msg::ElementKind::ELEMENT_LANE));
    event.id(id());
    event.other(id());
    return event;
  }));
  return m;
}

msg::RoadMarkings RandomMessages::road_markings() {
  msg::RoadMarkings m;
  m.header(header());
  m.markings(several(5, [&] { return marking(); }));
  return m;
}

msg::ServiceStatus RandomMessages::service_status() {
  const auto times = [&] {
    msg::TimeSummary summary;
    summary.mean_ms(number());
    summary.p50_ms(number());
    summary.p99_ms(number());
    summary.max_ms(number());
    return summary;
  };
  msg::ServiceStatus m;
  m.header(header());
  m.state(one_of(msg::MapState::MAP_STALE));
  m.reasons(several(3, [&] { return one_of(msg::StateReason::REASON_DRIVING_SIDE_CONTRADICTED); }));
  m.uptime_s(number());
  m.detections_age_s(number());
  m.poses_age_s(number());
  m.tick(times());
  m.tick_delay(times());
  m.pending_frames(static_cast<std::uint32_t>(whole(1000)));
  m.counters(several(5, [&] {
    msg::Counter counter;
    counter.name(text("counter").c_str());
    counter.value(id());
    return counter;
  }));
  m.sources(several(5, [&] {
    msg::SourceStatus source;
    source.source(text("camera").c_str());
    source.session_id(id());
    source.first_sequence(id());
    source.last_sequence(id());
    source.frames(id());
    source.fused(id());
    source.lag_s(number());
    source.learned(several(3, [&] {
      msg::NamedValue value;
      value.name(text("value").c_str());
      value.value(number());
      return value;
    }));
    return source;
  }));
  m.version(text("version").c_str());
  m.config_hash(text("hash").c_str());
  m.configuration(several(3, [&] {
    msg::Setting setting;
    setting.key(text("key").c_str());
    setting.value(text("value").c_str());
    return setting;
  }));
  return m;
}

}  // namespace laneloom::dds
