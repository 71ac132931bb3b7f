// What a run will take, known before it starts: memory where an analysis needs whole trajectories,
// disk where there are files.
#pragma once

#include <cstdint>
#include <string>

#include "compiler/ir/model.h"

namespace twincraft {

/// Samples that an engine records, nearly.
double samples_of(const Model& model);

/// [bytes] of a trajectory of one engine that is kept.
double trajectory_bytes(const Model& model);

/// [bytes] of the files of one engine, rather too few: zeros are short.
double file_bytes(const Model& model, bool netcdf);

/// More memory than this is refused [bytes].
inline constexpr double kMostMemory = 2.0 * 1024 * 1024 * 1024;

/// `record` [s] with which as many trajectories fit into kMostMemory, two digits, rounded up.
double record_that_fits(const Model& model, double trajectories);

/// Empty, or that the disk has no room: `cannot write `out`: ...`.
/// @param free  [bytes] that a file system has left
std::string check_room(const std::string& folder, double needed, double free, double record);

/// [bytes] that are left where `folder` is or will be; infinite when the system does not say.
double free_bytes(const std::string& folder);

/// `7.3 GiB`
std::string size_words(double bytes);

}  // namespace twincraft
