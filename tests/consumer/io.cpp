#include <cstdio>
#include <string_view>

#include "hedgerow/io/read.h"

// Reads a triangle from memory: done when it arrives.
int main() {
  constexpr std::string_view kText = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
  const auto read = hedgerow::io::read_bytes({kText.data(), kText.size()},
                                             hedgerow::io::Format::obj, "triangle.obj");
  if (!read) {
    std::puts(read.error().message.c_str());
    return 1;
  }
  return read->soup.vertex_count() == 3 && read->soup.face_count() == 1 ? 0 : 1;
}
