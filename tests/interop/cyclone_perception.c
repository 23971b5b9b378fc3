// cyclone_perception DOMAIN VEHICLE_ID FILE: what stock_perception.cpp is, on Cyclone DDS.
#include <dds/dds.h>
#include <ifaddrs.h>
#include <inttypes.h>
#include <net/if.h>
#include <signal.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <sys/socket.h>

#include "Detections.h"
#include "VehiclePose.h"

enum { kPaddingPoints = 1000 };
static const int64_t kPeriod_ns = DDS_MSECS(100);

static volatile sig_atomic_t told_to_end = 0;

static void end(int signal_number) {
  (void)signal_number;
  told_to_end = 1;
}

/// Cyclone refuses the one interface of a host without a network, if it is not told to take it.
static void use_loopback_without_network(void) {
  struct ifaddrs* all = NULL;
  bool network = false;
  if (getifaddrs(&all) != 0) return;
  for (const struct ifaddrs* i = all; i; i = i->ifa_next)
    network |= i->ifa_addr && i->ifa_addr->sa_family == AF_INET && !(i->ifa_flags & IFF_LOOPBACK);
  freeifaddrs(all);
  const char* loopback =
      "<General><Interfaces><NetworkInterface name=\"lo\" multicast=\"true\"/></Interfaces></General>";
  if (!network) setenv("CYCLONEDDS_URI", loopback, 0);
}

/// Ends the process when DDS refuses.
static dds_entity_t made(dds_entity_t entity, const char* what) {
  if (entity >= 0) return entity;
  fprintf(stderr, "%s: %s\n", what, dds_strretcode(-entity));
  exit(EXIT_FAILURE);
}

/// The stamp of the newest pose that has come; none: `before`.
static int64_t newest_stamp_ns(dds_entity_t poses, int64_t before) {
  void* sample = NULL;
  dds_sample_info_t info;
  while (dds_take(poses, &sample, &info, 1, 1) == 1) {
    if (info.valid_data) before = ((const laneloom_msg_VehiclePose*)sample)->header.stamp_ns;
    dds_return_loan(poses, &sample, 1);
  }
  return before;
}

static void perceive(dds_entity_t poses, dds_entity_t detections, FILE* log) {
  static laneloom_msg_Point points[kPaddingPoints];
  for (int i = 0; i < kPaddingPoints; ++i) points[i].x = 0.01 * i;
  // The padding is a line that nobody trusts.
  laneloom_msg_Detection padding = {.type = laneloom_msg_LANELINE,
                                    .confidence = 0.05,
                                    .points = {._length = kPaddingPoints, ._buffer = points}};
  laneloom_msg_MarkingType types[] = {laneloom_msg_STOPLINE};
  laneloom_msg_Detections frame = {.header = {.session_id = (uint64_t)dds_time(), .frame_id = "base_link"},
                                   .source = "cyclone_perception",
                                   .detected_types = {._length = 1, ._buffer = types},
                                   .detections = {._length = 1, ._buffer = &padding}};
  fprintf(log, "session_id,sequence,published_ns\n");
  while (!told_to_end) {
    const int64_t stamp_ns = newest_stamp_ns(poses, frame.header.stamp_ns);
    if (stamp_ns >= frame.header.stamp_ns + kPeriod_ns) {
      frame.header.stamp_ns = stamp_ns;
      ++frame.header.sequence_number;
      fprintf(log, "%" PRIu64 ",%" PRIu64 ",%" PRId64 "\n", frame.header.session_id,
              frame.header.sequence_number, dds_time());
      fflush(log);  // what was written stays when this is killed
      dds_write(detections, &frame);
    }
    dds_sleepfor(DDS_MSECS(10));
  }
}

int main(int argc, char** argv) {
  FILE* log = argc == 4 ? fopen(argv[3], "w") : NULL;
  if (!log) return EXIT_FAILURE;
  signal(SIGTERM, end);
  use_loopback_without_network();
  const dds_entity_t participant =
      made(dds_create_participant((dds_domainid_t)atoi(argv[1]), NULL, NULL), "participant");
  dds_qos_t* partition = dds_create_qos();
  dds_qset_partition1(partition, argv[2]);
  const dds_entity_t publisher = made(dds_create_publisher(participant, partition, NULL), "publisher");
  const dds_entity_t subscriber = made(dds_create_subscriber(participant, partition, NULL), "subscriber");
  const dds_entity_t detections =
      made(dds_create_topic(participant, &laneloom_msg_Detections_desc, "laneloom/v3/detections", NULL, NULL),
           "detections");
  const dds_entity_t poses = made(
      dds_create_topic(participant, &laneloom_msg_VehiclePose_desc, "laneloom/v3/vehicle_pose", NULL, NULL),
      "poses");
  perceive(made(dds_create_reader(subscriber, poses, NULL, NULL), "reader"),
           made(dds_create_writer(publisher, detections, NULL, NULL), "writer"), log);
  fclose(log);
  dds_delete_qos(partition);
  dds_delete(participant);
}
