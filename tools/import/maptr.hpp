#pragma once

#include <filesystem>

#include "import/drive_log.hpp"
#include "import/frame_collector.hpp"

namespace laneloom::imports {

/// Reads the files that the evaluation of MapTR and MapTRv2 writes (nuscmap_results.json,
/// av2map_results.json):
///
///     {"meta": …, "results": [{"sample_token": "…",
///       "vectors": [{"cls_name": "divider", "confidence_level": 0..1, "pts": [[x, y], …],
///                    "pts_num": 20, "type": 0}, …]}, …]}
///
/// This is the format of _format_bbox() in
/// projects/mmdet3d_plugin/datasets/{nuscenes,av2}_{map,offlinemap}_dataset.py of github.com/hustvl/MapTR,
/// branches main and maptrv2: points are metres (the head's denormalize_2d_pts), of three coordinates in the
/// 3D models for Argoverse 2. With nuScenes they are in the frame of the LiDAR, x right (+-15 m), y forward
/// (+-30 m), cut out of the map by the yaw of LiDAR to global; with Argoverse 2 in the vehicle's frame, x
/// forward (+-30 m), y left (+-15 m). Samples are called by nuScenes' token, or `<log id>_<LiDAR stamp in
/// ns>`; the samples of all drives of the data set are in one file. Lines have no style. They are written
/// even if their confidence is low.
///
/// What is wrong
/// is left out, and the rest comes: a vector with another class, a confidence out of 0..1 or a point that is
/// not finite, a sample that is malformed or comes twice, and what follows the place where the file is
/// damaged. Throws std::runtime_error naming the file and the problem: it is no such file, or has no sample
/// of the drive; also of the first wrong value if `reading.left_out` is strict.
ImportedFrames read_maptr(const std::filesystem::path& path, const ResultsReading& reading);

}  // namespace laneloom::imports
