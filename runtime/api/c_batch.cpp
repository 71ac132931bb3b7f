// The C interface: batches. See include/twincraft.h.
#include "runtime/api/batch.h"
#include "runtime/api/handles.h"

struct tc_batch {
  std::unique_ptr<twincraft::api::Batch> batch;
  twincraft::api::HandleParts parts;

  bool is_whole() const { return batch != nullptr; }
};

using namespace twincraft;
using namespace twincraft::api;

extern "C" {

tc_status tc_batch_new(const tc_model* model, size_t count, size_t threads, tc_batch** batch) {
  if (model == nullptr || !model->is_whole() || batch == nullptr) return TC_USAGE;
  *batch = new (std::nothrow) tc_batch;
  if (*batch == nullptr) return TC_MEMORY;
  tc_batch& handle = **batch;
  return attempt(handle.parts.error,
                 [&] { handle.batch = std::make_unique<Batch>(model->model, count, threads); });
}

void tc_batch_free(tc_batch* batch) { delete batch; }

const char* tc_batch_error(const tc_batch* batch) {
  return batch == nullptr ? "out of memory" : batch->parts.error.c_str();
}

tc_status tc_batch_set_poll(tc_batch* batch, tc_poll poll, void* context) {
  return inside(batch, Use::kAsks, [&] {
    batch->parts.poll = poll;
    batch->parts.poll_context = context;
  });
}

size_t tc_batch_count(const tc_batch* batch) {
  return batch == nullptr || !batch->is_whole() ? 0 : batch->batch->count();
}

double tc_batch_time(const tc_batch* batch) {
  return number_inside(batch, [&] { return batch->batch->time(); });
}

tc_status tc_batch_states(tc_batch* batch, double* rows, size_t size) {
  return inside(batch, Use::kAsks, [&] {
    check_size(size, batch->batch->count() * batch->batch->model().states().size(), "states");
    batch->batch->read_states({rows, size});
  });
}

tc_status tc_batch_outputs(tc_batch* batch, double* rows, size_t size) {
  return inside(batch, Use::kAsks, [&] {
    check_size(size, batch->batch->count() * batch->batch->model().outputs().size(), "outputs");
    batch->batch->read_outputs({rows, size});
  });
}

tc_status tc_batch_inputs(tc_batch* batch, double* rows, size_t size) {
  return inside(batch, Use::kAsks, [&] {
    check_size(size, batch->batch->count() * batch->batch->model().inputs().size(), "inputs");
    batch->batch->read_inputs({rows, size});
  });
}

tc_status tc_batch_set_states(tc_batch* batch, const double* rows, size_t size) {
  return inside(batch, Use::kMoves, [&] { batch->batch->set_states({rows, size}); });
}

tc_status tc_batch_drive(tc_batch* batch, const double* rows, size_t size) {
  return inside(batch, Use::kMoves, [&] { batch->batch->drive({rows, size}); });
}

tc_status tc_batch_release(tc_batch* batch) {
  return inside(batch, Use::kMoves, [&] { batch->batch->release(); });
}

tc_status tc_batch_step(tc_batch* batch, size_t count) {
  return inside(batch, Use::kMoves, [&] {
    if (count == 0) refuse("a number of steps must be > 0");
    batch->batch->step(count, batch->parts.polled());
  });
}

tc_status tc_batch_status(tc_batch* batch, int32_t* status, size_t count) {
  return inside(batch, Use::kAsks, [&] {
    check_size(count, batch->batch->count(), "status");
    for (std::size_t i = 0; i < count; ++i)
      status[i] = batch->batch->failure(i).empty() ? TC_OK : TC_NUMERICAL;
  });
}

const char* tc_batch_reason(const tc_batch* batch, size_t member) {
  if (batch == nullptr || !batch->is_whole() || member >= batch->batch->count()) return "";
  return batch->batch->failure(member).c_str();
}

}  // extern "C"
