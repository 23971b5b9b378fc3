// perception DOMAIN VEHICLE_ID: publishes what a network sees and where the car is, on a straight road with
// one lane.
#include <dds/dds.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "Detections.h"
#include "VehiclePose.h"

enum { kPointsPerLine = 8, kPosesPerFrame = 10 };
static const double kSpeed_mps = 10.0;

/// Ends the process when DDS refuses.
static dds_entity_t made(dds_entity_t entity) {
  if (entity >= 0) return entity;
  fprintf(stderr, "%s\n", dds_strretcode(-entity));
  exit(EXIT_FAILURE);
}

static dds_entity_t writer(dds_entity_t publisher, const dds_topic_descriptor_t* type, const char* name) {
  const dds_entity_t participant = made(dds_get_participant(publisher));
  const dds_entity_t topic = made(dds_create_topic(participant, type, name, NULL, NULL));
  dds_qos_t* qos = dds_create_qos();
  dds_qset_reliability(qos, DDS_RELIABILITY_RELIABLE, DDS_MSECS(50));
  const dds_entity_t result = made(dds_create_writer(publisher, topic, qos, NULL));
  dds_delete_qos(qos);
  return result;
}

/// A line beside the car in the body frame (x forward, y left, z up).
static laneloom_msg_Detection laneline(laneloom_msg_Point* points, double left_m) {
  for (int i = 0; i < kPointsPerLine; ++i) points[i] = (laneloom_msg_Point){5.0 * i - 5.0, left_m, 0.0};
  return (laneloom_msg_Detection){.type = laneloom_msg_LANELINE,
                                  .style = laneloom_msg_STYLE_SOLID,
                                  .confidence = 0.9,
                                  .points = {._length = kPointsPerLine, ._buffer = points}};
}

static void write_frame(dds_entity_t frames, laneloom_msg_Header header) {
  laneloom_msg_Point left[kPointsPerLine], right[kPointsPerLine];
  laneloom_msg_Detection lines[] = {laneline(left, 1.75), laneline(right, -1.75)};
  laneloom_msg_Detections frame = {
      .header = header, .source = "example", .detections = {._length = 2, ._buffer = lines}};
  frame.header.sequence_number /= kPosesPerFrame;
  strcpy(frame.header.frame_id, "base_link");
  dds_write(frames, &frame);
}

int main(int argc, char** argv) {
  if (argc != 3) {
    fprintf(stderr, "usage: perception DOMAIN VEHICLE_ID\n");
    return EXIT_FAILURE;
  }
  const dds_entity_t participant = made(dds_create_participant((dds_domainid_t)atoi(argv[1]), NULL, NULL));
  dds_qos_t* partition = dds_create_qos();
  dds_qset_partition1(partition, argv[2]);
  const dds_entity_t publisher = made(dds_create_publisher(participant, partition, NULL));
  dds_delete_qos(partition);
  const dds_entity_t poses = writer(publisher, &laneloom_msg_VehiclePose_desc, "laneloom/v3/vehicle_pose");
  const dds_entity_t frames = writer(publisher, &laneloom_msg_Detections_desc, "laneloom/v3/detections");

  const int64_t start_ns = dds_time();
  for (uint64_t number = 1;; ++number) {
    dds_sleepfor(DDS_MSECS(10));
    laneloom_msg_VehiclePose pose = {
        .header = {.stamp_ns = dds_time(), .sequence_number = number, .session_id = (uint64_t)start_ns},
        .pose = {.orientation = {.w = 1.0}}};
    pose.pose.position.x = kSpeed_mps * 1e-9 * (double)(pose.header.stamp_ns - start_ns);
    strcpy(pose.header.frame_id, "map");
    dds_write(poses, &pose);
    if (number % kPosesPerFrame == 0) write_frame(frames, pose.header);
  }
}
