#pragma once

namespace limpid::tool {

/// Makes Ctrl-C, kill and a closed terminal end the process as they do anyway, but without leaving
/// temporary files; a signal that the caller ignores stays ignored. A write beyond a file-size
/// limit becomes an Error. Call it before any other thread starts.
void end_cleanly_on_signals();

/// Has `work` done before the process ends by such a signal: one for the whole process.
void also_on_signals(void (*work)());

}  // namespace limpid::tool
