#include <unistd.h>

#include "core/base/processor/instructions.hpp"

// Compiled for any x86-64 (CMakeLists.txt), and calls nothing but the system: a function that
// another source has too, a template above all, could be the other's, of instructions that are not
// there.

namespace drift {
namespace {

constexpr unsigned long longest = 512;
char lacking[longest] = " ";

unsigned long length(const char* text) {
  unsigned long n = 0;
  while (text[n] != '\0') ++n;
  return n;
}

bool is_needed(const char* name, unsigned long size) {
  for (const char* at = needed_instructions; *at != '\0'; ++at) {
    unsigned long same = 0;
    while (same < size && at[1 + same] == name[same]) ++same;
    if (*at == ' ' && same == size && at[1 + same] == ' ') return true;
  }
  return false;
}

void append(const char* name, unsigned long size) {
  unsigned long end = length(lacking);
  if (end + size + 2 > longest) return;
  for (unsigned long i = 0; i < size; ++i) lacking[end++] = name[i];
  lacking[end++] = ' ';
  lacking[end] = '\0';
}

void say(const char* text) {
  [[maybe_unused]] const auto written = write(STDERR_FILENO, text, length(text));
}

}  // namespace

/// Runs before the constructors of all other sources: those that give no priority have the last
/// one. Every program that links the library has it, by the name that CMakeLists.txt asks for.
extern "C" __attribute__((constructor(101))) void drift_look_at_cpu() {
#ifdef __x86_64__
  __builtin_cpu_init();
#define DRIFT_LOOK(name)                                                    \
  if (is_needed((name), sizeof(name) - 1) && !__builtin_cpu_supports(name)) \
  append((name), sizeof(name) - 1)
  DRIFT_LOOK("sse3");
  DRIFT_LOOK("ssse3");
  DRIFT_LOOK("sse4.1");
  DRIFT_LOOK("sse4.2");
  DRIFT_LOOK("sse4a");
  DRIFT_LOOK("popcnt");
  DRIFT_LOOK("bmi");
  DRIFT_LOOK("bmi2");
  DRIFT_LOOK("fma");
  DRIFT_LOOK("fma4");
  DRIFT_LOOK("xop");
  DRIFT_LOOK("avx");
  DRIFT_LOOK("avx2");
  DRIFT_LOOK("avx512f");
  DRIFT_LOOK("avx512vl");
  DRIFT_LOOK("avx512bw");
  DRIFT_LOOK("avx512dq");
  DRIFT_LOOK("avx512cd");
  DRIFT_LOOK("avx512vbmi");
  DRIFT_LOOK("avx512vnni");
  DRIFT_LOOK("avx512ifma");
#ifndef __clang__  // whose version 14 does not know these names
  DRIFT_LOOK("lzcnt");
  DRIFT_LOOK("movbe");
  DRIFT_LOOK("f16c");
#endif
#undef DRIFT_LOOK
#endif
  if (lacking[1] == '\0') return;
  say("driftscope: this processor lacks instructions that the program was compiled for:");
  say(lacking);
  say("(expected a processor like that of the build). Build it here, or once for all machines with "
      "`cmake --preset portable`\n");
  _exit(2);
}

}  // namespace drift
