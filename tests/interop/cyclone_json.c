#include "cyclone_json.h"

#include <inttypes.h>
#include <stdio.h>

// These print a field of the struct m with a function for its type: the first field, or a further one.
#define FIRST(field, print) (fputs("{\"" #field "\":", stdout), print(m->field))
#define NEXT(field, print) (fputs(",\"" #field "\":", stdout), print(m->field))
#define FIRST_STRUCT(field, print) (fputs("{\"" #field "\":", stdout), print(&m->field))
#define NEXT_STRUCT(field, print) (fputs(",\"" #field "\":", stdout), print(&m->field))
#define END putchar('}')

// Defines `name`, which prints a list of values or of structs, by the function that prints one.
#define LIST_BY(address, name, type, print)        \
  static void name(const type* list) {             \
    putchar('[');                                  \
    for (uint32_t i = 0; i < list->_length; ++i) { \
      if (i > 0) putchar(',');                     \
      print(address list->_buffer[i]);             \
    }                                              \
    putchar(']');                                  \
  }
#define LIST(name, type, print) LIST_BY(, name, type, print)
#define LIST_OF_STRUCTS(name, type, print) LIST_BY(&, name, type, print)

static void real(double value) { printf("%.17g", value); }
static void number(uint32_t value) { printf("%" PRIu32, value); }  // enumerators, too
static void large(uint64_t value) { printf("\"%" PRIu64 "\"", value); }
static void stamp(int64_t value) { printf("\"%" PRId64 "\"", value); }
static void truth(bool value) { fputs(value ? "true" : "false", stdout); }
static void text(const char* value) { printf("\"%s\"", value); }  // has nothing to be escaped

LIST(reals, laneloom_msg_PointValues, real)
LIST(covariance, dds_sequence_double, real)

static void point(const laneloom_msg_Point* m) { FIRST(x, real), NEXT(y, real), NEXT(z, real), END; }
LIST_OF_STRUCTS(polyline, laneloom_msg_Polyline, point)

static void quaternion(const laneloom_msg_Quaternion* m) {
  FIRST(x, real), NEXT(y, real), NEXT(z, real), NEXT(w, real), END;
}

static void pose(const laneloom_msg_Pose* m) {
  FIRST_STRUCT(position, point), NEXT_STRUCT(orientation, quaternion), END;
}

static void range(const laneloom_msg_Range* m) { FIRST(from_m, real), NEXT(to_m, real), END; }
LIST_OF_STRUCTS(ranges, dds_sequence_laneloom_msg_Range, range)

static void header(const laneloom_msg_Header* m) {
  FIRST(crc, large), NEXT(data_id, number), NEXT(stamp_ns, stamp), NEXT(sequence_number, large);
  NEXT(session_id, large), NEXT(frame_id, text), END;
}

static void area(const laneloom_msg_Area* m) { FIRST_STRUCT(outline, polyline), END; }
LIST_OF_STRUCTS(areas, dds_sequence_laneloom_msg_Area, area)

static void detection(const laneloom_msg_Detection* m) {
  FIRST(type, number), NEXT(style, number), NEXT(confidence, real);
  NEXT_STRUCT(points, polyline), NEXT_STRUCT(stddev_m, reals), END;
}
LIST_OF_STRUCTS(detections, dds_sequence_laneloom_msg_Detection, detection)
LIST(marking_types, dds_sequence_laneloom_msg_MarkingType, number)

static void style_range(const laneloom_msg_StyleRange* m) {
  FIRST_STRUCT(range, range), NEXT(style, number), END;
}
LIST_OF_STRUCTS(styles, dds_sequence_laneloom_msg_StyleRange, style_range)

static void marking(const laneloom_msg_Marking* m) {
  FIRST(id, large), NEXT(type, number), NEXT(status, number), NEXT_STRUCT(points, polyline);
  NEXT_STRUCT(styles, styles), NEXT_STRUCT(lateral_stddev_m, reals), NEXT(existence_probability, real);
  NEXT(observations, large), NEXT(age_s, real), NEXT(unseen_s, real), END;
}
LIST_OF_STRUCTS(markings, dds_sequence_laneloom_msg_Marking, marking)

static void neighbour(const laneloom_msg_Neighbour* m) {
  FIRST(lane, large), NEXT_STRUCT(range, range), NEXT_STRUCT(crossable, ranges), END;
}
LIST_OF_STRUCTS(neighbours, dds_sequence_laneloom_msg_Neighbour, neighbour)

static void border(const laneloom_msg_Border* m) {
  FIRST(boundary, large), NEXT_STRUCT(range, range), NEXT_STRUCT(on_boundary, range), END;
}
LIST_OF_STRUCTS(borders, dds_sequence_laneloom_msg_Border, border)

static void lane(const laneloom_msg_Lane* m) {
  FIRST(id, large), NEXT_STRUCT(left_borders, borders), NEXT_STRUCT(right_borders, borders);
  NEXT_STRUCT(left, polyline), NEXT_STRUCT(right, polyline), NEXT_STRUCT(centerline, polyline);
  NEXT(width_m, real), NEXT_STRUCT(left_neighbours, neighbours), NEXT_STRUCT(right_neighbours, neighbours);
  NEXT(direction, number), NEXT(direction_probability, real), NEXT(direction_evidence, number);
  NEXT(use, number), NEXT(use_probability, real), NEXT(section, number), NEXT(status, number);
  NEXT(existence_probability, real), NEXT(evidence, number), NEXT_STRUCT(inferred_ranges, ranges), END;
}
LIST_OF_STRUCTS(lanes, dds_sequence_laneloom_msg_Lane, lane)
LIST(ids, dds_sequence_unsigned_long_long, large)

static void stopline(const laneloom_msg_Stopline* m) {
  FIRST_STRUCT(marking, marking), NEXT_STRUCT(lanes, ids), NEXT_STRUCT(heading, point), END;
}
LIST_OF_STRUCTS(stoplines, dds_sequence_laneloom_msg_Stopline, stopline)

static void linkage(const laneloom_msg_Linkage* m) {
  FIRST(from_lane, large), NEXT(to_lane, large), NEXT(kind, number), NEXT(turn, number);
  NEXT(probability, real), NEXT(evidence, number), NEXT_STRUCT(path, polyline), END;
}
LIST_OF_STRUCTS(linkages, dds_sequence_laneloom_msg_Linkage, linkage)

static void way_station(const laneloom_msg_WayStation* m) {
  FIRST_STRUCT(point, point), NEXT(heading_rad, real), NEXT(curvature_per_m, real), NEXT(lane, large);
  NEXT(left_m, real), NEXT(right_m, real), NEXT(width_m, real), NEXT(lateral_stddev_m, real);
  NEXT(status, number), NEXT(may_change_left, truth), NEXT(may_change_right, truth), END;
}
LIST_OF_STRUCTS(way_stations, dds_sequence_laneloom_msg_WayStation, way_station)

static void way_lane(const laneloom_msg_WayLane* m) {
  FIRST(lane, large), NEXT(against, truth), NEXT(entry, number), NEXT_STRUCT(range, range), END;
}
LIST_OF_STRUCTS(way_lanes, dds_sequence_laneloom_msg_WayLane, way_lane)

static void way(const laneloom_msg_Way* m) {
  FIRST(step_m, real), NEXT_STRUCT(stations, way_stations), NEXT_STRUCT(lanes, way_lanes);
  NEXT(known_m, real), NEXT(confirmed_m, real), END;
}

static void driven_path(const laneloom_msg_DrivenPath* m) {
  FIRST(id, large), NEXT_STRUCT(points, polyline), NEXT(lateral_stddev_m, real), NEXT(probability, real), END;
}
LIST_OF_STRUCTS(driven_paths, dds_sequence_laneloom_msg_DrivenPath, driven_path)

static void lineage_event(const laneloom_msg_LineageEvent* m) {
  FIRST(kind, number), NEXT(element, number), NEXT(id, large), NEXT(other, large), END;
}
LIST_OF_STRUCTS(lineage, dds_sequence_laneloom_msg_LineageEvent, lineage_event)

static void fused_frame(const laneloom_msg_FusedFrame* m) {
  FIRST(source, text), NEXT(session_id, large), NEXT(sequence_number, large), NEXT(stamp_ns, stamp), END;
}
LIST_OF_STRUCTS(fused_frames, dds_sequence_laneloom_msg_FusedFrame, fused_frame)
LIST(reasons, dds_sequence_laneloom_msg_StateReason, number)

static void time_summary(const laneloom_msg_TimeSummary* m) {
  FIRST(mean_ms, real), NEXT(p50_ms, real), NEXT(p99_ms, real), NEXT(max_ms, real), END;
}

static void counter(const laneloom_msg_Counter* m) { FIRST(name, text), NEXT(value, large), END; }
LIST_OF_STRUCTS(counters, dds_sequence_laneloom_msg_Counter, counter)

static void named_value(const laneloom_msg_NamedValue* m) { FIRST(name, text), NEXT(value, real), END; }
LIST_OF_STRUCTS(named_values, dds_sequence_laneloom_msg_NamedValue, named_value)

static void setting(const laneloom_msg_Setting* m) { FIRST(key, text), NEXT(value, text), END; }
LIST_OF_STRUCTS(settings, dds_sequence_laneloom_msg_Setting, setting)

static void source(const laneloom_msg_SourceStatus* m) {
  FIRST(source, text), NEXT(session_id, large), NEXT(first_sequence, large), NEXT(last_sequence, large);
  NEXT(frames, large), NEXT(fused, large), NEXT(lag_s, real), NEXT_STRUCT(learned, named_values), END;
}
LIST_OF_STRUCTS(sources, dds_sequence_laneloom_msg_SourceStatus, source)

static void begin(const char* topic) { printf("{\"topic\":\"%s\",\"message\":", topic); }
static void end(void) {
  puts("}}");
  fflush(stdout);
}

void print_detections(const laneloom_msg_Detections* m) {
  begin("detections");
  FIRST_STRUCT(header, header), NEXT(source, text), NEXT_STRUCT(detected_types, marking_types);
  NEXT_STRUCT(field_of_view, polyline), NEXT_STRUCT(occluded_areas, areas);
  NEXT_STRUCT(detections, detections), end();
}

void print_vehicle_pose(const laneloom_msg_VehiclePose* m) {
  begin("vehicle_pose");
  FIRST_STRUCT(header, header), NEXT_STRUCT(pose, pose), NEXT_STRUCT(covariance, covariance), end();
}

void print_lane_map(const laneloom_msg_LaneMap* m) {
  begin("lane_map");
  FIRST_STRUCT(header, header), NEXT(published_ns, stamp), NEXT(map_id, large), NEXT(age_s, real);
  NEXT(lag_s, real), NEXT(state, number);
  NEXT_STRUCT(reasons, reasons), NEXT_STRUCT(pose, pose), NEXT_STRUCT(fused_frames, fused_frames);
  NEXT_STRUCT(boundaries, markings), NEXT_STRUCT(lanes, lanes), NEXT_STRUCT(stoplines, stoplines);
  NEXT_STRUCT(linkages, linkages), NEXT_STRUCT(way, way), NEXT_STRUCT(driven_paths, driven_paths);
  NEXT_STRUCT(lineage, lineage), end();
}

void print_road_markings(const laneloom_msg_RoadMarkings* m) {
  begin("road_markings");
  FIRST_STRUCT(header, header), NEXT_STRUCT(markings, markings), end();
}

void print_status(const laneloom_msg_ServiceStatus* m) {
  begin("status");
  FIRST_STRUCT(header, header), NEXT(state, number), NEXT_STRUCT(reasons, reasons), NEXT(uptime_s, real);
  NEXT(detections_age_s, real), NEXT(poses_age_s, real);
  NEXT_STRUCT(tick, time_summary), NEXT_STRUCT(tick_delay, time_summary), NEXT(pending_frames, number);
  NEXT_STRUCT(counters, counters), NEXT_STRUCT(sources, sources), NEXT(version, text);
  NEXT(config_hash, text), NEXT_STRUCT(configuration, settings), end();
}
