#include "injection.h"

namespace hedgerow::bench {

double inject_delay(const std::string&, std::chrono::steady_clock::time_point) { return 0; }

}  // namespace hedgerow::bench
