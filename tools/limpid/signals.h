#pragma once

namespace limpid::tool {

/// Makes Ctrl-C, kill and a closed terminal end the process as usual, but without leftover
/// temporary files; a signal that the caller ignores stays ignored. A write beyond a file-size
/// limit becomes an Error. To be called before any other thread starts.
void end_cleanly_on_signals();

/// Runs `work` before the process ends by such a signal: one function per process.
void also_on_signals(void (*work)());

}  // namespace limpid::tool
