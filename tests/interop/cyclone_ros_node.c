// cyclone_ros_node DOMAIN NAMESPACE FILE [SECONDS]: what a node of ROS 2 is on DDS, on Cyclone DDS, with the
// names and the quality of service that rclcpp gives by default. It drives along a straight road with one
// lane, behind another vehicle: writes nav_msgs/Odometry, laneloom_msgs/Detections and
// autoware_perception_msgs/TrackedObjects, and prints what it reads of the service into FILE, a line each,
// until it is killed. With SECONDS, it writes no detections after them.
#include <dds/dds.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "AutowareMaplessPlanningMsgs.h"
#include "AutowarePerceptionMsgs.h"
#include "Detections.h"
#include "DiagnosticMsgs.h"
#include "LaneMap.h"
#include "NavMsgs.h"
#include "RmwDdsCommon.h"
#include "VisualizationMsgs.h"

enum { kStep_ms = 10, kFramePeriod_ms = 100 };
static const int64_t kStart_s = 1700000000;
static const double kSpeed_mps = 5.0;
static int64_t blind_after_ms = INT64_MAX;
static FILE* output;

/// Ends the process when DDS refuses.
static dds_entity_t made(dds_entity_t entity, const char* what) {
  if (entity >= 0) return entity;
  fprintf(stderr, "%s: %s\n", what, dds_strretcode(-entity));
  exit(EXIT_FAILURE);
}

/// A topic below the namespace, whose type is called `type_name`.
static dds_entity_t topic(dds_entity_t participant, const dds_topic_descriptor_t* type, const char* type_name,
                          const char* name_space, const char* name) {
  dds_topic_descriptor_t* renamed = malloc(sizeof *renamed);  // for as long as the process lives
  if (renamed == NULL) abort();
  memcpy(renamed, type, sizeof *renamed);
  memcpy((char*)renamed + offsetof(dds_topic_descriptor_t, m_typename), &type_name, sizeof type_name);
  char full[256];
  snprintf(full, sizeof full, "%s%s", name_space, name);
  return made(dds_create_topic(participant, renamed, full, NULL, NULL), full);
}

/// rclcpp's default: reliable, volatile, keep last 10.
static dds_qos_t* default_qos(void) {
  dds_qos_t* qos = dds_create_qos();
  dds_qset_reliability(qos, DDS_RELIABILITY_RELIABLE, DDS_MSECS(100));
  dds_qset_durability(qos, DDS_DURABILITY_VOLATILE);
  dds_qset_history(qos, DDS_HISTORY_KEEP_LAST, 10);
  return qos;
}

static dds_qos_t* latched_qos(void) {
  dds_qos_t* qos = default_qos();
  dds_qset_durability(qos, DDS_DURABILITY_TRANSIENT_LOCAL);
  return qos;
}

static dds_qos_t* best_effort_qos(void) {
  dds_qos_t* qos = dds_create_qos();
  dds_qset_reliability(qos, DDS_RELIABILITY_BEST_EFFORT, 0);
  return qos;
}

#define SEQUENCE(array) \
  { ._length = sizeof(array) / sizeof *(array), ._buffer = (array) }

static std_msgs_msg_dds__Header_ header_at(int64_t time_ms) {
  return (std_msgs_msg_dds__Header_){.stamp = {.sec = (int32_t)(kStart_s + time_ms / 1000),
                                               .nanosec = (uint32_t)(time_ms % 1000) * 1000000U},
                                     .frame_id = "map"};
}

static void write_odometry(dds_entity_t writer, int64_t time_ms) {
  const nav_msgs_msg_dds__Odometry_ odometry = {
      .header = header_at(time_ms),
      .child_frame_id = "base_link",
      .pose = {.pose = {.position = {.x = kSpeed_mps * (double)time_ms / 1e3}, .orientation = {.w = 1.0}},
               .covariance = {[0] = 0.01}},
      .twist = {.twist = {.linear = {.x = kSpeed_mps}}}};
  dds_write(writer, &odometry);
}

/// The vehicle ahead, in the map frame.
static void write_objects(dds_entity_t writer, int64_t time_ms) {
  autoware_perception_msgs_msg_dds__ObjectClassification_ car = {.label = 1, .probability = 0.9F};
  autoware_perception_msgs_msg_dds__TrackedObject_ vehicle = {
      .object_id = {.uuid = {[0] = 1}},
      .existence_probability = 0.9F,
      .classification = {._length = 1, ._buffer = &car},
      .kinematics = {.pose_with_covariance = {.pose = {.position = {.x = 12.0 +
                                                                         kSpeed_mps * (double)time_ms / 1e3,
                                                                    .z = 0.75},
                                                       .orientation = {.w = 1.0}},
                                              .covariance = {[0] = 0.04, [7] = 0.04}},
                     .twist_with_covariance = {.twist = {.linear = {.x = kSpeed_mps}}},
                     .orientation_availability = 2},
      .shape = {.dimensions = {.x = 4.5, .y = 1.8, .z = 1.5}}};
  const autoware_perception_msgs_msg_dds__TrackedObjects_ message = {
      .header = header_at(time_ms), .objects = {._length = 1, ._buffer = &vehicle}};
  dds_write(writer, &message);
}

/// Both lines of the lane, without a session: the writer's counts.
static void write_detections(dds_entity_t writer, int64_t time_ms) {
  laneloom_msg_Detection lines[2];
  laneloom_msg_Point points[2][8];
  memset(lines, 0, sizeof lines);
  for (int i = 0; i < 2; ++i) {
    for (int j = 0; j < 8; ++j)
      points[i][j] = (laneloom_msg_Point){.x = -5.0 + 5.0 * j, .y = i == 0 ? 1.75 : -1.75};
    lines[i].style = laneloom_msg_STYLE_SOLID;
    lines[i].confidence = 0.9;
    lines[i].points = (laneloom_msg_Polyline)SEQUENCE(points[i]);
  }
  laneloom_msg_Detections message = {
      .header = {.stamp_ns = (kStart_s * 1000 + time_ms) * 1000000, .frame_id = "base_link"},
      .source = "ros node",
      .detections = SEQUENCE(lines)};
  dds_write(writer, &message);
}

static void print_map(const void* sample) {
  const laneloom_msg_LaneMap* map = sample;
  uint32_t evidence = 0;  // of all directions
  for (uint32_t i = 0; i < map->lanes._length; ++i) evidence |= map->lanes._buffer[i].direction_evidence;
  fprintf(output,
          "{\"topic\":\"lane_map\",\"state\":%d,\"lanes\":%u,\"traffic\":%s,\"fused\":%u,\"session\":%s}\n",
          (int)map->state, map->lanes._length,
          (evidence & laneloom_msg_EVIDENCE_TRAFFIC) != 0 ? "true" : "false", map->fused_frames._length,
          map->fused_frames._length > 0 && map->fused_frames._buffer[0].session_id != 0 ? "true" : "false");
}

static void print_markers(const void* sample) {
  const visualization_msgs_msg_dds__MarkerArray_* array = sample;
  for (uint32_t i = 0; i < array->markers._length; ++i) {
    const visualization_msgs_msg_dds__Marker_* marker = &array->markers._buffer[i];
    fprintf(output,
            "{\"topic\":\"marker\",\"ns\":\"%s\",\"id\":%d,\"type\":%d,\"action\":%d,\"frame\":\"%s\","
            "\"points\":%u}\n",
            marker->ns, marker->id, marker->type, marker->action, marker->header.frame_id,
            marker->points._length);
  }
}

static void print_segments(const void* sample) {
  const autoware_mapless_planning_msgs_msg_dds__RoadSegments_* road = sample;
  for (uint32_t i = 0; i < road->segments._length; ++i) {
    const autoware_mapless_planning_msgs_msg_dds__Segment_* segment = &road->segments._buffer[i];
    fprintf(output,
            "{\"topic\":\"segment\",\"frame\":\"%s\",\"id\":%u,\"left_y\":%.3f,\"right_y\":%.3f,\"ego_x\":%."
            "3f,\"neighbours\":%u}\n",
            road->header.frame_id, segment->id, segment->linestrings[0].poses._buffer[0].position.y,
            segment->linestrings[1].poses._buffer[0].position.y, road->pose.position.x,
            segment->neighboring_segment_id._length);
  }
}

static void print_diagnostics(const void* sample) {
  const diagnostic_msgs_msg_dds__DiagnosticArray_* array = sample;
  for (uint32_t i = 0; i < array->status._length; ++i) {
    const diagnostic_msgs_msg_dds__DiagnosticStatus_* status = &array->status._buffer[i];
    fprintf(
        output,
        "{\"topic\":\"diagnostics\",\"name\":\"%s\",\"level\":%u,\"message\":\"%s\",\"hardware\":\"%s\"}\n",
        status->name, status->level, status->message, status->hardware_id);
  }
}

static void print_node(const void* sample) {
  const rmw_dds_common_msg_dds__ParticipantEntitiesInfo_* info = sample;
  for (uint32_t i = 0; i < info->node_entities_info_seq._length; ++i) {
    const rmw_dds_common_msg_dds__NodeEntitiesInfo_* node = &info->node_entities_info_seq._buffer[i];
    fprintf(
        output, "{\"topic\":\"node\",\"namespace\":\"%s\",\"name\":\"%s\",\"readers\":%u,\"writers\":%u}\n",
        node->node_namespace, node->node_name, node->reader_gid_seq._length, node->writer_gid_seq._length);
  }
}

static void print_user_data(const char* topic, const char* name, const dds_qos_t* qos) {
  void* data = NULL;
  size_t size = 0;
  if (!dds_qget_userdata(qos, &data, &size)) return;
  fprintf(output, "{\"topic\":\"%s\",\"name\":\"%s\",\"user_data\":\"%.*s\"}\n", topic, name, (int)size,
          (const char*)data);
  dds_free(data);
}

static void print_participant(const void* sample) {
  const dds_builtintopic_participant_t* participant = sample;
  print_user_data("participant", "", participant->qos);
}

static void print_writer(const void* sample) {
  const dds_builtintopic_endpoint_t* writer = sample;
  print_user_data("writer", writer->topic_name, writer->qos);
}

static void print_reader(const void* sample) {
  const dds_builtintopic_endpoint_t* reader = sample;
  print_user_data("reader", reader->topic_name, reader->qos);
}

/// Prints what came since the last call.
static void print_new(dds_entity_t reader, void (*print)(const void*)) {
  void* sample = NULL;
  dds_sample_info_t info;
  while (dds_take(reader, &sample, &info, 1, 1) > 0) {
    if (info.valid_data) print(sample);
    dds_return_loan(reader, &sample, 1);
  }
  fflush(output);
}

typedef struct {
  const dds_topic_descriptor_t* type;
  const char *type_name, *name_space, *name;
  dds_qos_t* qos;
  void (*print)(const void*);
  dds_entity_t builtin_topic;  ///< where there is no type
  dds_entity_t reader;
} Output;

/// The writers of the node.
typedef struct {
  dds_entity_t odometry, detections, objects;
} Inputs;

static void run(Inputs inputs, const Output* outputs, int count) {
  for (int64_t time_ms = 0;; time_ms += kStep_ms) {
    write_odometry(inputs.odometry, time_ms);
    if (time_ms % kFramePeriod_ms == 0) write_objects(inputs.objects, time_ms);
    if (time_ms % kFramePeriod_ms == 0 && time_ms < blind_after_ms)
      write_detections(inputs.detections, time_ms);
    for (int i = 0; i < count; ++i) print_new(outputs[i].reader, outputs[i].print);
    dds_sleepfor(DDS_MSECS(kStep_ms));
  }
}

int main(int argc, char** argv) {
  if (argc != 4 && argc != 5) {
    fprintf(stderr, "usage: %s DOMAIN NAMESPACE FILE [SECONDS]\n", argv[0]);
    return EXIT_FAILURE;
  }
  if (argc == 5) blind_after_ms = 1000 * atoi(argv[4]);
  output = fopen(argv[3], "w");
  if (output == NULL) {
    perror(argv[3]);
    return EXIT_FAILURE;
  }
  const dds_entity_t participant =
      made(dds_create_participant((dds_domainid_t)atoi(argv[1]), NULL, NULL), "participant");
  char below[128];
  snprintf(below, sizeof below, "rt%s/", argv[2]);
  const dds_entity_t odometry =
      topic(participant, &nav_msgs_msg_dds__Odometry__desc, "nav_msgs::msg::dds_::Odometry_", below, "odom");
  const dds_entity_t detections =
      topic(participant, &laneloom_msg_Detections_desc, "laneloom_msgs::msg::dds_::Detections_", below,
            "laneloom/detections");
  const dds_entity_t objects =
      topic(participant, &autoware_perception_msgs_msg_dds__TrackedObjects__desc,
            "autoware_perception_msgs::msg::dds_::TrackedObjects_", below, "tracked_objects");
  Output outputs[] = {
      {&laneloom_msg_LaneMap_desc, "laneloom_msgs::msg::dds_::LaneMap_", below, "laneloom/lane_map",
       default_qos(), print_map, 0, 0},
      {&visualization_msgs_msg_dds__MarkerArray__desc, "visualization_msgs::msg::dds_::MarkerArray_", below,
       "laneloom/markers", default_qos(), print_markers, 0, 0},
      {&autoware_mapless_planning_msgs_msg_dds__RoadSegments__desc,
       "autoware_mapless_planning_msgs::msg::dds_::RoadSegments_", below, "laneloom/road_segments",
       best_effort_qos(), print_segments, 0, 0},
      {&diagnostic_msgs_msg_dds__DiagnosticArray__desc, "diagnostic_msgs::msg::dds_::DiagnosticArray_", "rt/",
       "diagnostics", default_qos(), print_diagnostics, 0, 0},
      {&rmw_dds_common_msg_dds__ParticipantEntitiesInfo__desc,
       "rmw_dds_common::msg::dds_::ParticipantEntitiesInfo_", "", "ros_discovery_info", latched_qos(),
       print_node, 0, 0},
      {NULL, NULL, NULL, "participants", NULL, print_participant, DDS_BUILTIN_TOPIC_DCPSPARTICIPANT, 0},
      {NULL, NULL, NULL, "writers", NULL, print_writer, DDS_BUILTIN_TOPIC_DCPSPUBLICATION, 0},
      {NULL, NULL, NULL, "readers", NULL, print_reader, DDS_BUILTIN_TOPIC_DCPSSUBSCRIPTION, 0}};
  const int count = sizeof outputs / sizeof *outputs;
  for (int i = 0; i < count; ++i) {
    Output* o = &outputs[i];
    const dds_entity_t read = o->type == NULL
                                  ? o->builtin_topic
                                  : topic(participant, o->type, o->type_name, o->name_space, o->name);
    o->reader = made(dds_create_reader(participant, read, o->qos, NULL), o->name);
  }
  const Inputs inputs = {made(dds_create_writer(participant, odometry, default_qos(), NULL), "odometry"),
                         made(dds_create_writer(participant, detections, default_qos(), NULL), "detections"),
                         made(dds_create_writer(participant, objects, default_qos(), NULL), "objects")};
  run(inputs, outputs, count);
}
