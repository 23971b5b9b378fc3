// cyclone_participant DOMAIN VEHICLE_ID FILE [KILOBYTES PERIOD_MS]: perception, odometry and planning of a
// car on a straight road with one lane, on Cyclone DDS. Prints every message that it writes or reads into
// FILE (cyclone_json.h), until it is killed. With KILOBYTES, each frame is padded to that size, and frames
// are not printed.
#include <dds/dds.h>
#include <dds/ddsi/ddsi_serdata.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "cyclone_json.h"

enum { kStep_ms = 10, kPaddingPoints = 1000 };
static int64_t frame_period_ms = 100;
static uint32_t padding_lines = 0;
static const int64_t kStart_ns = INT64_C(1700000000000000000);
static const double kSpeed_mps = 5.0;

/// Ends the process when DDS refuses.
static dds_entity_t made(dds_entity_t entity, const char* what) {
  if (entity >= 0) return entity;
  fprintf(stderr, "%s: %s\n", what, dds_strretcode(-entity));
  exit(EXIT_FAILURE);
}

static dds_entity_t topic(dds_entity_t participant, const dds_topic_descriptor_t* type, const char* name) {
  return made(dds_create_topic(participant, type, name, NULL, NULL), name);
}

/// Publisher or subscriber in the partition of the vehicle.
static dds_qos_t* partition_qos(const char* vehicle_id) {
  dds_qos_t* qos = dds_create_qos();
  dds_qset_partition1(qos, vehicle_id);
  return qos;
}

/// A planner asks for the map in time, and wants to learn that the service hangs.
static dds_qos_t* map_qos(void) {
  dds_qos_t* qos = dds_create_qos();
  dds_qset_reliability(qos, DDS_RELIABILITY_RELIABLE, DDS_MSECS(50));
  dds_qset_durability(qos, DDS_DURABILITY_TRANSIENT_LOCAL);
  dds_qset_history(qos, DDS_HISTORY_KEEP_LAST, 16);
  dds_qset_deadline(qos, DDS_MSECS(250));
  dds_qset_liveliness(qos, DDS_LIVELINESS_MANUAL_BY_TOPIC, DDS_MSECS(400));
  return qos;
}

static dds_qos_t* status_qos(void) {
  dds_qos_t* qos = dds_create_qos();
  dds_qset_reliability(qos, DDS_RELIABILITY_RELIABLE, DDS_MSECS(50));
  dds_qset_durability(qos, DDS_DURABILITY_TRANSIENT_LOCAL);
  return qos;
}

static dds_qos_t* input_qos(void) {
  dds_qos_t* qos = dds_create_qos();
  dds_qset_reliability(qos, DDS_RELIABILITY_BEST_EFFORT, 0);
  return qos;
}

static laneloom_msg_Header header(int64_t stamp_ns, int64_t sequence, uint64_t session, const char* frame) {
  laneloom_msg_Header m = {
      .stamp_ns = stamp_ns, .sequence_number = (uint64_t)sequence, .session_id = session};
  strncpy(m.frame_id, frame, sizeof m.frame_id - 1);
  return m;
}

#define SEQUENCE(array) \
  { ._length = sizeof(array) / sizeof *(array), ._buffer = (array) }

static void write_pose(dds_entity_t writer, int64_t time_ms) {
  double covariance[36] = {0.0};
  for (int i = 0; i < 6; ++i) covariance[7 * i] = 0.01 * (i + 1);
  const laneloom_msg_VehiclePose pose = {
      .header = header(kStart_ns + DDS_MSECS(time_ms), time_ms / kStep_ms, 5, "map"),
      .pose = {.position = {.x = kSpeed_mps * (double)time_ms / 1e3, .y = 0.25, .z = -0.5},
               .orientation = {.w = 1.0}},
      .covariance = SEQUENCE(covariance)};
  dds_write(writer, &pose);
  print_vehicle_pose(&pose);
}

static laneloom_msg_Detection laneline(laneloom_msg_Point* points, uint32_t count, double* stddev_m) {
  return (laneloom_msg_Detection){.type = laneloom_msg_LANELINE,
                                  .style = laneloom_msg_STYLE_DASHED,
                                  .confidence = 0.875,
                                  .points = {._length = count, ._buffer = points},
                                  .stddev_m = {._length = count, ._buffer = stddev_m}};
}

/// Lines that nobody trusts, for the size of the frame.
static laneloom_msg_Detection padding(void) {
  static laneloom_msg_Point points[kPaddingPoints];
  for (int i = 0; i < kPaddingPoints; ++i) points[i] = (laneloom_msg_Point){0.01 * i, 12.0, 0.0};
  laneloom_msg_Detection line = laneline(points, kPaddingPoints, NULL);
  line.stddev_m._length = 0;
  line.confidence = 0.05;
  return line;
}

static void write_frame(dds_entity_t writer, int64_t time_ms) {
  laneloom_msg_Point right[] = {{-5.0, -1.75, 0.125}, {25.0, -1.75, 0.25}};
  laneloom_msg_Point left[] = {{-5.0, 1.75, 0.125}, {10.0, 1.75, 0.125}, {25.0, 1.75, 0.25}};
  laneloom_msg_Point view[] = {{-5.0, -15.0, 0.0}, {30.0, -15.0, 0.0}, {30.0, 15.0, 0.0}, {-5.0, 15.0, 0.0}};
  laneloom_msg_Point car[] = {{12.0, 5.0, 0.0}, {16.0, 5.0, 0.0}, {16.0, 7.0, 0.0}};
  double stddev_m[] = {0.0625, 0.125, 0.25};
  laneloom_msg_Detection seen[512] = {laneline(right, 2, stddev_m), laneline(left, 3, stddev_m)};
  for (uint32_t i = 0; i < padding_lines; ++i) seen[2 + i] = padding();
  laneloom_msg_MarkingType types[] = {laneloom_msg_LANELINE, laneloom_msg_ROADEDGE};
  laneloom_msg_Area occluded[] = {{.outline = SEQUENCE(car)}};
  laneloom_msg_Detections frame = {
      // The frame comes late, as a network delivers it.
      .header = header(kStart_ns + DDS_MSECS(time_ms - 40), time_ms / frame_period_ms, 6, "base_link"),
      .source = "cyclone",
      .detected_types = SEQUENCE(types),
      .field_of_view = SEQUENCE(view),
      .occluded_areas = SEQUENCE(occluded),
      .detections = {._length = 2 + padding_lines, ._buffer = seen}};
  dds_write(writer, &frame);
  if (padding_lines == 0) print_detections(&frame);
}

/// The CRC-64/XZ that Header.crc is: of all bytes behind it, filled up with zeros to a multiple of four.
static uint64_t crc64(const unsigned char* bytes, size_t size) {
  uint64_t crc = ~UINT64_C(0);
  for (size_t i = 0; i < size; ++i) {
    crc ^= bytes[i];
    for (int bit = 0; bit < 8; ++bit) crc = (crc >> 1) ^ (UINT64_C(0xC96C5795D7870F42) & (0 - (crc & 1)));
  }
  return ~crc;
}

/// Whether a message came as its writer protected it. Behind four bytes of encapsulation lie crc and data_id.
static bool is_protected(const struct ddsi_serdata* message, uint32_t data_id) {
  enum { kCrc = 4, kDataId = 12, kBehind = 16 };
  const uint32_t size = ddsi_serdata_size(message);
  const uint32_t filled_up = (size + 3) / 4 * 4;
  unsigned char* bytes = dds_alloc(filled_up);  // zeros
  ddsi_serdata_to_ser(message, 0, size, bytes);
  uint64_t crc = 0;
  uint32_t id = 0;
  memcpy(&crc, bytes + kCrc, sizeof crc);
  memcpy(&id, bytes + kDataId, sizeof id);
  const bool holds = size >= kBehind && id == data_id && crc == crc64(bytes + kDataId, filled_up - kDataId);
  dds_free(bytes);
  return holds;
}

#define PRINT_ALL(reader, type, print, data_id)                                 \
  do {                                                                          \
    struct ddsi_serdata* message = NULL;                                        \
    dds_sample_info_t info;                                                     \
    while (dds_takecdr(reader, &message, 1, &info, DDS_ANY_STATE) == 1) {       \
      if (info.valid_data && is_protected(message, data_id)) {                  \
        void* sample = dds_alloc(sizeof(type));                                 \
        if (ddsi_serdata_to_sample(message, sample, NULL, NULL)) print(sample); \
        dds_sample_free(sample, &type##_desc, DDS_FREE_ALL);                    \
      } else if (info.valid_data) {                                             \
        puts("{\"topic\":\"damaged\",\"message\":{}}");                         \
      }                                                                         \
      ddsi_serdata_unref(message);                                              \
    }                                                                           \
  } while (0)

static void print_liveliness(dds_entity_t maps) {
  dds_liveliness_changed_status_t status;
  if (dds_get_liveliness_changed_status(maps, &status) != DDS_RETCODE_OK) return;
  if (status.alive_count_change == 0 && status.not_alive_count_change == 0) return;
  printf("{\"topic\":\"alive\",\"message\":%u}\n", (unsigned)status.alive_count);
  fflush(stdout);
}

int main(int argc, char** argv) {
  if ((argc != 4 && argc != 6) || !freopen(argv[3], "w", stdout)) {
    fprintf(stderr, "usage: cyclone_participant DOMAIN VEHICLE_ID FILE [KILOBYTES PERIOD_MS]\n");
    return EXIT_FAILURE;
  }
  if (argc == 6) {
    padding_lines = (uint32_t)(atoi(argv[4]) * 1000 / (int)(kPaddingPoints * sizeof(laneloom_msg_Point)));
    if (padding_lines > 510) padding_lines = 510;
    frame_period_ms = atoi(argv[5]);
  }
  const dds_entity_t participant =
      made(dds_create_participant((dds_domainid_t)atoi(argv[1]), NULL, NULL), "participant");
  dds_qos_t* partition = partition_qos(argv[2]);
  const dds_entity_t publisher = made(dds_create_publisher(participant, partition, NULL), "publisher");
  const dds_entity_t subscriber = made(dds_create_subscriber(participant, partition, NULL), "subscriber");
  dds_delete_qos(partition);
  const dds_entity_t detections_topic =
      topic(participant, &laneloom_msg_Detections_desc, "laneloom/v3/detections");
  const dds_entity_t pose_topic =
      topic(participant, &laneloom_msg_VehiclePose_desc, "laneloom/v3/vehicle_pose");
  const dds_entity_t map_topic = topic(participant, &laneloom_msg_LaneMap_desc, "laneloom/v3/lane_map");
  const dds_entity_t markings_topic =
      topic(participant, &laneloom_msg_RoadMarkings_desc, "laneloom/v3/road_markings");
  const dds_entity_t status_topic =
      topic(participant, &laneloom_msg_ServiceStatus_desc, "laneloom/v3/status");

  const dds_entity_t detections =
      made(dds_create_writer(publisher, detections_topic, input_qos(), NULL), "detections");
  const dds_entity_t poses = made(dds_create_writer(publisher, pose_topic, input_qos(), NULL), "poses");
  const dds_entity_t maps = made(dds_create_reader(subscriber, map_topic, map_qos(), NULL), "maps");
  const dds_entity_t markings =
      made(dds_create_reader(subscriber, markings_topic, map_qos(), NULL), "markings");
  const dds_entity_t statuses =
      made(dds_create_reader(subscriber, status_topic, status_qos(), NULL), "status");

  for (int64_t time_ms = 0;; time_ms += kStep_ms) {
    write_pose(poses, time_ms);
    if (time_ms > 0 && time_ms % frame_period_ms == 0) write_frame(detections, time_ms);
    print_liveliness(maps);
    PRINT_ALL(maps, laneloom_msg_LaneMap, print_lane_map, laneloom_msg_DATA_ID_LANE_MAP);
    PRINT_ALL(markings, laneloom_msg_RoadMarkings, print_road_markings, laneloom_msg_DATA_ID_ROAD_MARKINGS);
    PRINT_ALL(statuses, laneloom_msg_ServiceStatus, print_status, laneloom_msg_DATA_ID_STATUS);
    dds_sleepfor(DDS_MSECS(kStep_ms));
  }
}
