// The Python that both halves of a script share. Only what a vehicle asks for is in it.
#pragma once

#include <set>
#include <string>
#include <string_view>

namespace twincraft {

/// @param modules  of Basilisk.simulation
std::string imports_code(const std::set<std::string>& modules);

struct ScriptNeeds {
  bool is_point = false;
  bool is_adaptive = false;  // the method is
  std::string_view engine;   // the half that is built where none is asked for
};

/// The class of the vehicle, what puts it into a task, and the command line.
/// @param halves  the methods of both halves
std::string vehicle_code(const ScriptNeeds& needs, const std::string& halves);

}  // namespace twincraft
