// Variables are listed once, then defined, then written. Tested by tests/runtime/netcdf_test.cpp.
#include "runtime/report/netcdf.h"

#include <fmt/format.h>
#include <netcdf.h>

#include <array>
#include <functional>
#include <mutex>
#include <stdexcept>
#include <utility>
#include <vector>

#include "runtime/report/printed_time.h"

namespace twincraft {
namespace {

void check(int status) {
  if (status != NC_NOERR) throw std::runtime_error(fmt::format("netcdf: {}", nc_strerror(status)));
}

struct Variable {
  std::string name, unit, words;
  int components = 1;  // 1, 3 or 4
  std::function<double(const Observation&, int component)> value;
  int id = -1;
  std::vector<double> waiting = {};  // of samples that are not yet in the file
};

Variable vector_variable(const char* name, const char* unit, const char* words,
                         Vector3d Observation::*vector) {
  return {name, unit, words, 3, [vector](const Observation& o, int i) { return (o.*vector)[i]; }};
}

Variable scalar(std::string name, const char* unit, std::string words,
                std::function<double(const Observation&)> value) {
  return {std::move(name), unit, std::move(words), 1,
          [value = std::move(value)](const Observation& o, int) { return value(o); }};
}

void add_coordinate(const Coordinate& coordinate, std::vector<Variable>& variables) {
  const std::string& name = coordinate.name;
  const auto index = static_cast<std::size_t>(coordinate.index);
  if (coordinate.kind == Coordinate::Kind::kWheel) {
    variables.push_back(scalar(name + ".rate", "rad s-1", "spin relative to the mount",
                               [index](const Observation& o) { return o.wheel_rate[index]; }));
    return;
  }
  const bool length = coordinate.is_length();
  variables.push_back(
      scalar(name + ".position", length ? "m" : "rad", length ? "displacement" : "angle",
             [index](const Observation& o) { return o.joint_position[index - 1]; }));
  variables.push_back(scalar(name + ".rate", length ? "m s-1" : "rad s-1",
                             length ? "speed" : "rate of the angle",
                             [index](const Observation& o) { return o.joint_rate[index - 1]; }));
}

std::vector<Variable> variables_of(const Model& model) {
  std::vector<Variable> variables{
      scalar("time", "s", "time since the start",
             [printed = PrintedTime(model.simulation.step)](const Observation& o) {
               return printed(o.time);
             }),
      vector_variable("r_BN_N", "m", "hub origin, inertial axes", &Observation::r_BN_N),
      vector_variable("v_BN_N", "m s-1", "velocity of the hub origin, inertial axes",
                      &Observation::v_BN_N),
      {"q_BN", "1", "quaternion, scalar first, takes hub components to inertial ones", 4,
       [](const Observation& o, int i) { return i == 0 ? o.q_BN.w() : o.q_BN.vec()[i - 1]; }},
      vector_variable("omega_BN_B", "rad s-1", "hub rate relative to inertial axes, hub axes",
                      &Observation::omega_BN_B),
      vector_variable("r_CN_N", "m", "system centre of mass, inertial axes", &Observation::r_CN_N),
      vector_variable("v_CN_N", "m s-1", "velocity of the system centre of mass, inertial axes",
                      &Observation::v_CN_N)};
  for (const Coordinate& coordinate : model.coordinates) add_coordinate(coordinate, variables);
  variables.push_back(
      scalar("mass", "kg", "mass of the vehicle", [](const Observation& o) { return o.mass; }));
  return variables;
}

/// netCDF and HDF5 keep what they know of all files in one place: one thread at a time.
std::mutex& library() {
  static std::mutex mutex;
  return mutex;
}

/// A file that is let go of on every way out.
class File {
 public:
  explicit File(const std::string& path) { check(nc_create(path.c_str(), NC_NETCDF4, &id_)); }
  ~File() {
    if (open_) nc_abort(id_);
  }
  File(const File&) = delete;
  File& operator=(const File&) = delete;

  int id() const { return id_; }

  int dimension(const char* name, std::size_t length) const {
    int dimension = -1;
    check(nc_def_dim(id_, name, length, &dimension));
    return dimension;
  }

  void attribute(int variable, const char* name, const std::string& text) const {
    check(nc_put_att_text(id_, variable, name, text.size(), text.data()));
  }

  void close() {
    open_ = false;
    check(nc_close(id_));
  }

 private:
  int id_ = -1;
  bool open_ = true;
};

void describe(const File& file, const Bundle& bundle, std::string_view engine,
              const Provenance& provenance) {
  const auto put = [&](const char* name, const std::string& text) {
    file.attribute(NC_GLOBAL, name, text);
  };
  put("title", bundle.model.name);
  put("summary", bundle.model.description);
  put("engine", std::string(engine));
  put("spec_file", bundle.spec_file);
  put("spec_sha256", bundle.spec_sha256);
  put("source", provenance.program);
  put("git", provenance.git);
  put("compiler", provenance.compiler);
  put("compiler_flags", provenance.flags);
  put("mujoco", provenance.mujoco);
  put("eigen", provenance.eigen);
  std::string settings;
  for (const Setting& setting : bundle.settings)
    settings += fmt::format("{}={}\n", setting.path, setting.text);
  put("settings", settings);
}

/// How many samples go into the file at a time; a chunk of it holds as many.
constexpr std::size_t kSamplesPerChunk = 1024;

void define_variable(const File& file, int time, int components, Variable& variable) {
  const std::array<int, 2> dimensions{time, components};
  const int count = variable.components == 1 ? 1 : 2;
  const auto width = static_cast<std::size_t>(variable.components);
  check(nc_def_var(file.id(), variable.name.c_str(), NC_DOUBLE, count, dimensions.data(),
                   &variable.id));
  const std::array<std::size_t, 2> chunk{kSamplesPerChunk, width};
  check(nc_def_var_chunking(file.id(), variable.id, NC_CHUNKED, chunk.data()));
  check(nc_def_var_deflate(file.id(), variable.id, 1, 1, 1));
  // A chunk is written once, so two in memory are enough; by default there are sixteen megabytes.
  check(nc_set_var_chunk_cache(file.id(), variable.id,
                               2 * kSamplesPerChunk * width * sizeof(double), 3, 1.0F));
  file.attribute(variable.id, "units", variable.unit);
  file.attribute(variable.id, "long_name", variable.words);
}

void define(const File& file, std::vector<Variable>& variables) {
  const int time = file.dimension("time", NC_UNLIMITED);
  const int xyz = file.dimension("xyz", 3), wxyz = file.dimension("wxyz", 4);
  for (Variable& variable : variables)
    define_variable(file, time, variable.components == 4 ? wxyz : xyz, variable);
  check(nc_enddef(file.id()));
}

}  // namespace

class NetcdfFile::Contents {
 public:
  Contents(const std::string& path, const Bundle& bundle, std::string_view engine,
           const Provenance& provenance)
      : variables_(variables_of(bundle.model)), file_(path) {
    describe(file_, bundle, engine, provenance);
    define(file_, variables_);
  }

  void take(const Observation& sample) {
    for (Variable& variable : variables_)
      for (int i = 0; i < variable.components; ++i)
        variable.waiting.push_back(variable.value(sample, i));
    if (++waiting_ < kSamplesPerChunk) return;
    const std::scoped_lock lock(library());
    flush();
  }

  void close() {
    flush();
    file_.close();
  }

 private:
  void flush() {
    for (Variable& variable : variables_) {
      const std::array<std::size_t, 2> start{written_, 0};
      const std::array<std::size_t, 2> count{waiting_,
                                             static_cast<std::size_t>(variable.components)};
      if (waiting_ > 0)
        check(nc_put_vara_double(file_.id(), variable.id, start.data(), count.data(),
                                 variable.waiting.data()));
      variable.waiting.clear();
    }
    written_ += std::exchange(waiting_, 0);
  }

  std::vector<Variable> variables_;
  File file_;
  std::size_t written_ = 0, waiting_ = 0;  // samples
};

NetcdfFile::NetcdfFile(const std::string& path, const Bundle& bundle, std::string_view engine,
                       const Provenance& provenance) {
  const std::scoped_lock lock(library());
  contents_ = std::make_unique<Contents>(path, bundle, engine, provenance);
}

NetcdfFile::~NetcdfFile() {
  const std::scoped_lock lock(library());
  contents_.reset();
}

void NetcdfFile::take(const Observation& sample) { contents_->take(sample); }

void NetcdfFile::close() {
  const std::scoped_lock lock(library());
  contents_->close();
}

}  // namespace twincraft
