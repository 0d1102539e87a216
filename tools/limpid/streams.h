#pragma once

namespace limpid::tool {

/// Opens stdin, stdout and stderr on /dev/null if the caller has closed them: else the next file
/// would take their number, and printed text would go into its pixels. A closed pipe no longer ends
/// the process, because its output is only a report of the work. To be called before any file is
/// opened.
void keep_streams_apart();

/// Flushes the output. If its reader has gone, the process ends by SIGPIPE, as it would have at
/// once. Throws Error for other write errors, as on a full disk.
void finish_stdout();

}  // namespace limpid::tool
