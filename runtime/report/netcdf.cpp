// Variables are defined, then written. Tested by tests/runtime/netcdf_test.cpp.
#include "runtime/report/netcdf.h"

#include <fmt/format.h>
#include <netcdf.h>

#include <array>
#include <functional>
#include <mutex>
#include <utility>
#include <vector>

#include "runtime/report/netcdf_file.h"
#include "runtime/report/printed_time.h"

namespace twincraft {
namespace {

using netcdf::as_product;
using netcdf::check;
using netcdf::File;
using netcdf::library;

struct Variable {
  std::string name, unit, words;
  std::size_t components = 1;  // 1, 3 or 4
  std::function<double(const Observation&, std::size_t component)> value;
  int id = -1;
  std::vector<double> waiting = {};  // of samples that are not yet in the file
};

Variable variable_of(const OutputSignal& output) {
  return {output.name, as_product(output.unit), output.meaning, output.size(),
          [output](const Observation& o, std::size_t i) { return value_of(output, i, o); }};
}

std::vector<Variable> variables_of(const Model& model) {
  std::vector<Variable> variables{
      {"time", "s", "time since the start", 1,
       [printed = PrintedTime(model.simulation.step)](
           const Observation& o, std::size_t /*component*/) { return printed(o.time); }}};
  for (const OutputSignal& output : outputs_of(model)) variables.push_back(variable_of(output));
  return variables;
}

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
  netcdf::describe(file, provenance);
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
  check(nc_def_var(file.id(), variable.name.c_str(), NC_DOUBLE, count, dimensions.data(),
                   &variable.id));
  const std::array<std::size_t, 2> chunk{kSamplesPerChunk, variable.components};
  check(nc_def_var_chunking(file.id(), variable.id, NC_CHUNKED, chunk.data()));
  check(nc_def_var_deflate(file.id(), variable.id, 1, 1, 1));
  // A chunk is written once, so two in memory are enough; by default there are sixteen megabytes.
  check(nc_set_var_chunk_cache(file.id(), variable.id,
                               2 * kSamplesPerChunk * variable.components * sizeof(double), 3,
                               1.0F));
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

bool has_netcdf() { return true; }

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
      for (std::size_t i = 0; i < variable.components; ++i)
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
      const std::array<std::size_t, 2> count{waiting_, variable.components};
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
