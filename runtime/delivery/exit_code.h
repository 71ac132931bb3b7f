// What a run comes to, as a number: the exit codes of both programs.
#pragma once

namespace twincraft {

enum ExitCode {
  kExitDone = 0,
  kExitFindings = 1,
  kExitUsage = 2,
  kExitInputOutput = 3,
  kExitFailure = 4,
  kExitInterrupted = 130,  // as after SIGINT; a program that knows the signal says which
};

}  // namespace twincraft
