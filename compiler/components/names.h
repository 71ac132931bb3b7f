// Who is who in a spec: every named component with what it is and where it was named. References
// from one component to another are resolved here. Tested by tests/compiler/spec_test.cpp.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "compiler/diag/diagnostics.h"

namespace twincraft {

class Names {
 public:
  /// Report a name that another component already has, with a note at the first.
  /// @param what  the kind of component, for messages: "wheel"
  void add(const std::string& name, const std::string& what, Span span, Diagnostics& diagnostics);

  /// What kind of component has this name; empty: none.
  std::string what(const std::string& name) const;
  std::vector<std::string> all() const;
  /// The names of all components of one kind.
  std::vector<std::string> all(const std::string& what) const;

 private:
  struct Entry {
    std::string what;
    Span span;
  };
  std::map<std::string, Entry> entries_;
};

/// Report a mount that does not exist or cannot carry anything: only the hub and bodies can.
/// @param who   what is to be mounted, for messages: "wheel `rw_x`"
void check_mount(const std::string& mount, Span span, const std::string& who, const Names& names,
                 Diagnostics& diagnostics);

/// Report a tank that does not exist. @param who  what names it: "thruster `main`"
void check_tank(const std::string& tank, Span span, const std::string& who, const Names& names,
                Diagnostics& diagnostics);

}  // namespace twincraft
