#pragma once

namespace limpid::tool {

/// Opens stdin, stdout and stderr on nothing where the caller has closed them: else the next file
/// would take their place, and get what is printed into its pixels. A pipe that nobody reads any
/// more no longer ends the process: what is printed tells of the work, it is not the work. Call it
/// before any file is opened.
void keep_streams_apart();

/// Writes out what was printed. Where nobody reads it any more the process ends by SIGPIPE, as it
/// would have at once. Throws Error where it cannot be written otherwise, as on a full disk.
void finish_stdout();

}  // namespace limpid::tool
