#pragma once

#include <cstdint>
#include <filesystem>

#include "import/drive_log.hpp"
#include "import/frame_collector.hpp"

namespace laneloom::imports {

/// The network that wrote a file of results.
enum class StreamNetwork : std::uint8_t { streammapnet, maptracker };

/// Reads the file that the evaluation of StreamMapNet and MapTracker writes (submission_vector.json):
///
///     {"meta": …, "results": {"<sample token>": {"vectors": [[[x, y], …], …], "scores": [0..1, …],
///                                                "labels": [0, …], …}, …}}
///
/// This is the format of format_results() in plugin/datasets/base_dataset.py of
/// github.com/yuantianyuan01/StreamMapNet and github.com/woodfrog/maptracker, and the cat2id of their
/// configurations: label 0 is ped_crossing, 1 divider and 2 boundary. Points are metres, x forward, y left
/// (roi_size 60 x 30 or 100 x 50). With Argoverse 2, and with nuScenes in StreamMapNet, they are in the
/// vehicle's frame; with nuScenes in MapTracker they are about the LiDAR, turned by its yaw. A sample of
/// Argoverse 2 is called by its stamp in ns alone. MapTracker's tracks are not read: laneloom makes ids of
/// its own.
///
/// Another label is a class by its number. What is wrong is left out, and the rest comes: a vector with
/// another label, a score out of 0..1 or a point that is not finite, a sample that is malformed, has lists of
/// different lengths or comes twice, and what follows the place where the file is damaged. Throws
/// std::runtime_error naming the file and the problem: it is no such file, or has no sample of the drive;
/// also of the first wrong value if `reading.left_out` is strict.
ImportedFrames read_streammapnet(const std::filesystem::path& path, StreamNetwork network,
                                 const ResultsReading& reading);

}  // namespace laneloom::imports
