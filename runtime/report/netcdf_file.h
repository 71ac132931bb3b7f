// What all netCDF files of ours have in common. Only sources that are built with the library see
// it.
#pragma once

#include <cstddef>
#include <mutex>
#include <string>

#include "runtime/study/provenance.h"

namespace twincraft::netcdf {

/// @throws std::runtime_error  with the library's own words
void check(int status);

/// netCDF and HDF5 keep what they know of all files in one place: one thread at a time.
std::mutex& library();

/// `rad s-1` of `rad/s`, `m3 s-2` of `m3/s2`: how the CF conventions write units.
std::string as_product(const std::string& unit);

/// A file that is let go of on every way out.
class File {
 public:
  explicit File(const std::string& path);
  ~File();
  File(const File&) = delete;
  File& operator=(const File&) = delete;

  int id() const { return id_; }
  int dimension(const char* name, std::size_t length) const;
  void attribute(int variable, const char* name, const std::string& text) const;
  void attribute(int variable, const char* name, double number) const;
  void close();

 private:
  int id_ = -1;
  bool open_ = true;
};

/// Which program wrote the file.
void describe(const File& file, const Provenance& provenance);

}  // namespace twincraft::netcdf
