#pragma once

#include <cstdint>

#include "dataset.h"
#include "representations/representation.h"

namespace hedgerow::bench {

/// The answer, from the face list and the reference's pairs alone. \pre triangles, and one fan at
/// each vertex
[[nodiscard]] std::uint64_t expected_answer(const Dataset& data, Question question, bool is_closed);

/// How many elements a question is asked of; for the Euler characteristic, how many edges.
[[nodiscard]] double question_elements(const Dataset& data, Question question);

}  // namespace hedgerow::bench
