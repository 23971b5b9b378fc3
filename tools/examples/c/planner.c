// planner DOMAIN VEHICLE_ID: follows the lane map, and says where its own way leads.
#include <dds/dds.h>
#include <inttypes.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>

#include "LaneMap.h"

/// Ends the process when DDS refuses.
static dds_entity_t made(dds_entity_t entity) {
  if (entity >= 0) return entity;
  fprintf(stderr, "%s\n", dds_strretcode(-entity));
  exit(EXIT_FAILURE);
}

/// What a planner asks for: the map in time, and to learn that the service hangs.
static dds_qos_t* map_qos(void) {
  dds_qos_t* qos = dds_create_qos();
  dds_qset_reliability(qos, DDS_RELIABILITY_RELIABLE, DDS_MSECS(50));
  dds_qset_durability(qos, DDS_DURABILITY_TRANSIENT_LOCAL);
  dds_qset_history(qos, DDS_HISTORY_KEEP_LAST, 1);
  dds_qset_deadline(qos, DDS_MSECS(250));
  dds_qset_liveliness(qos, DDS_LIVELINESS_MANUAL_BY_TOPIC, DDS_MSECS(400));
  return qos;
}

/// Why a planner must not drive on the map. Null: it may.
static const char* obstacle(const laneloom_msg_LaneMap* map) {
  for (uint32_t i = 0; i < map->reasons._length; ++i)
    if (map->reasons._buffer[i] == laneloom_msg_REASON_ANOTHER_SERVICE)
      return "two services write maps in turn";
  return map->state == laneloom_msg_MAP_STALE ? "the map is stale" : NULL;
}

static void plan(const laneloom_msg_LaneMap* map) {
  const char* why = obstacle(map);
  if (why) {
    printf("no map to drive on: %s\n", why);
    return;
  }
  printf("%u lanes; the way ahead is known for %.0f m\n", (unsigned)map->lanes._length, map->way.known_m);
  for (uint32_t i = 0; i < map->way.stations._length && i < 3; ++i) {
    const laneloom_msg_WayStation* at = &map->way.stations._buffer[i];
    printf("  lane %" PRIu64 ": x %.2f m, y %.2f m, heading %.3f rad, curvature %.4f/m, width %.2f m\n",
           at->lane, at->point.x, at->point.y, at->heading_rad, at->curvature_per_m, at->width_m);
  }
}

int main(int argc, char** argv) {
  if (argc != 3) {
    fprintf(stderr, "usage: planner DOMAIN VEHICLE_ID\n");
    return EXIT_FAILURE;
  }
  setvbuf(stdout, NULL, _IOLBF, 0);
  const dds_entity_t participant = made(dds_create_participant((dds_domainid_t)atoi(argv[1]), NULL, NULL));
  dds_qos_t* partition = dds_create_qos();
  dds_qset_partition1(partition, argv[2]);
  const dds_entity_t subscriber = made(dds_create_subscriber(participant, partition, NULL));
  dds_delete_qos(partition);
  const dds_entity_t topic =
      made(dds_create_topic(participant, &laneloom_msg_LaneMap_desc, "laneloom/v3/lane_map", NULL, NULL));
  dds_qos_t* qos = map_qos();
  const dds_entity_t maps = made(dds_create_reader(subscriber, topic, qos, NULL));
  dds_delete_qos(qos);

  for (int silent = 0;; dds_sleepfor(DDS_MSECS(100))) {
    void* sample = NULL;
    dds_sample_info_t info;
    const bool came = dds_take(maps, &sample, &info, 1, 1) == 1;
    silent = came && info.valid_data ? 0 : silent + 1;
    if (silent == 0) plan(sample);
    if (silent == 3) printf("no map came for 300 ms: stop\n");  // the service hangs, or is gone
    if (came) dds_return_loan(maps, &sample, 1);
  }
}
