#pragma once

namespace hedgerow::bench {

/// Adds to the header of the results what a reader needs to judge them: processor, memory, system,
/// huge pages, governor, compiler, flags, index width, versions of the peers, and what is known to
/// be odd about the framework.
void add_machine_context();

}  // namespace hedgerow::bench
