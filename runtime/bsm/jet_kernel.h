// A kernel for vehicles whose propellant leaves as a jet: forces that follow the motion at every
// stage, where the kernel itself holds forces from event to event. It stands around another kernel,
// so that the step of all other vehicles knows nothing of it.
#pragma once

#include <memory>

#include "runtime/bsm/kernel.h"
#include "runtime/forces/jet.h"

namespace twincraft::bsm {

/// @param inner  of one spacecraft, made from `plan`  @param jets  held by the caller
/// `plan` and `jets` must outlive it.
std::unique_ptr<Kernel> with_jets(std::unique_ptr<Kernel> inner, const Plan& plan,
                                  const JetModel& jets);

}  // namespace twincraft::bsm
