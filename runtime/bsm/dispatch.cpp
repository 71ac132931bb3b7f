// The kernel and the observer of each instruction set.
// Tested by tests/runtime/kernel_test.cpp.
#include <array>

#include "runtime/bsm/kernel.h"
#include "runtime/bsm/observer.h"

namespace twincraft::bsm {

#define TWINCRAFT_DECLARE_KERNEL(set)                           \
  namespace set {                                               \
  Kernel* new_kernel(const Plan* plan);                         \
  Kernel* new_batch_kernel(std::span<const Plan* const> plans); \
  std::size_t lanes_of_batch();                                 \
  Observer* new_observer(const Plan& plan, const Assembly&);    \
  }
TWINCRAFT_DECLARE_KERNEL(portable)
TWINCRAFT_DECLARE_KERNEL(avx2)
TWINCRAFT_DECLARE_KERNEL(avx512)
#undef TWINCRAFT_DECLARE_KERNEL

namespace {

struct Entries {
  Kernel* (*new_kernel)(const Plan*);
  Kernel* (*new_batch_kernel)(std::span<const Plan* const>);
  std::size_t (*lanes_of_batch)();
  Observer* (*new_observer)(const Plan&, const Assembly&);
};

// In the order of InstructionSet.
constexpr std::array<Entries, 3> kSets{{
    {portable::new_kernel, portable::new_batch_kernel, portable::lanes_of_batch,
     portable::new_observer},
    {avx2::new_kernel, avx2::new_batch_kernel, avx2::lanes_of_batch, avx2::new_observer},
    {avx512::new_kernel, avx512::new_batch_kernel, avx512::lanes_of_batch, avx512::new_observer},
}};

const Entries& entries(InstructionSet set) { return kSets[static_cast<std::size_t>(set)]; }

}  // namespace

std::unique_ptr<Kernel> make_kernel(const Plan& plan, InstructionSet set) {
  return std::unique_ptr<Kernel>(entries(set).new_kernel(&plan));
}

std::size_t batch_lanes(InstructionSet set) { return entries(set).lanes_of_batch(); }

std::unique_ptr<Kernel> make_batch_kernel(std::span<const Plan* const> plans, InstructionSet set) {
  return std::unique_ptr<Kernel>(entries(set).new_batch_kernel(plans));
}

std::unique_ptr<Observer> make_observer(const Plan& plan, const Assembly& assembly,
                                        InstructionSet set) {
  return std::unique_ptr<Observer>(entries(set).new_observer(plan, assembly));
}

}  // namespace twincraft::bsm
