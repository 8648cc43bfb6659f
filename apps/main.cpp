#include <cstdio>
#include <exception>
#include <new>
#include <string>

#include "apps/command_line.hpp"
#include "apps/exit_codes.hpp"
#include "apps/interrupt.hpp"
#include "apps/program.hpp"
#include "core/delaunay.hpp"
#include "core/run_control.hpp"
#include "gis/error.hpp"

namespace {

using namespace coastmesh;

int fail(ExitCode code, const std::string& message) {
  std::fprintf(stderr, "coastmesh: error: %s\n", message.c_str());
  return code;
}

// The only place where errors become messages and exit codes.
int guardedMain(int argc, char** argv) {
  Interrupt interrupt;
  try {
    return runProgram(argc, argv, interrupt);
  } catch (const UsageText& asked) {
    std::fputs(asked.text.c_str(), stdout);
    return kExitDone;
  } catch (const UsageError& error) {
    return fail(kExitUsage, error.what());
  } catch (const InputError& error) {
    return fail(kExitInput, error.what());
  } catch (const BadPslg& error) {
    return fail(kExitInput, error.what());
  } catch (const OutputError& error) {
    return fail(kExitOutput, error.what());
  } catch (const Cancelled&) {
    return fail(kExitInterrupted, "interrupted");
  } catch (const std::bad_alloc&) {
    return fail(kExitInput,
                "this takes more memory than there is; mesh the input in parts, or ask for larger triangles");
  } catch (const std::exception& error) {
    return fail(kExitBug, std::string("this is a bug of coastmesh, please report it: ") + error.what());
  }
}

}  // namespace

int main(int argc, char** argv) { return guardedMain(argc, argv); }
