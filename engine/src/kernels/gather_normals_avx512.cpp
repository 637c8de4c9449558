// Sixteen vertices at a time.

#include "kernels/gather_rings.h"
#include "kernels/normals_avx512.h"

namespace hedgerow::kernels {

#if defined(__AVX512F__)

namespace {

struct Lanes16 {
  using Int = Int16;
  using Float = Float16;

  static Vec3<Float16> from_rows(const __m128* rows) noexcept {
    const auto four = [rows](int i) {
      return joined(_mm256_insertf128_ps(_mm256_castps128_ps256(rows[i]), rows[i + 4], 1),
                    _mm256_insertf128_ps(_mm256_castps128_ps256(rows[i + 8]), rows[i + 12], 1));
    };
    return to_lanes(four(0), four(1), four(2), four(3));
  }
};

}  // namespace

template <NormalWeight W>
std::uint64_t gather_group_avx512(Index first, Index size, std::uint64_t wanted,
                                  const TriangleView& mesh, const GatherInput& input,
                                  TermWindow& window, const NormalWriter& writer) noexcept {
  return with_loader16(input.points, [&](const auto& loader) {
    const InRow place{first};
    return size == kLargeGroup
               ? gather_rings<W, Lanes16, 4>(place, wanted, mesh, input, window, loader, writer)
               : gather_rings<W, Lanes16, 2>(place, wanted, mesh, input, window, loader, writer);
  });
}

template <NormalWeight W>
std::uint64_t gather_listed_avx512(const Index* ids, std::uint64_t wanted, const TriangleView& mesh,
                                   const GatherInput& input, const NormalWriter& writer) noexcept {
  TermWindow none;
  return with_loader16(input.points, [&](const auto& loader) {
    return gather_rings<W, Lanes16, 2>(Listed{ids}, wanted, mesh, input, none, loader, writer);
  });
}

#else

template <NormalWeight W>
std::uint64_t gather_group_avx512(Index, Index, std::uint64_t wanted, const TriangleView&,
                                  const GatherInput&, TermWindow&, const NormalWriter&) noexcept {
  return wanted;
}

template <NormalWeight W>
std::uint64_t gather_listed_avx512(const Index*, std::uint64_t wanted, const TriangleView&,
                                   const GatherInput&, const NormalWriter&) noexcept {
  return wanted;
}

#endif

template std::uint64_t gather_group_avx512<NormalWeight::uniform>(Index, Index, std::uint64_t,
                                                                  const TriangleView&,
                                                                  const GatherInput&, TermWindow&,
                                                                  const NormalWriter&) noexcept;
template std::uint64_t gather_group_avx512<NormalWeight::area>(Index, Index, std::uint64_t,
                                                               const TriangleView&,
                                                               const GatherInput&, TermWindow&,
                                                               const NormalWriter&) noexcept;
template std::uint64_t gather_group_avx512<NormalWeight::angle>(Index, Index, std::uint64_t,
                                                                const TriangleView&,
                                                                const GatherInput&, TermWindow&,
                                                                const NormalWriter&) noexcept;
template std::uint64_t gather_group_avx512<NormalWeight::max>(Index, Index, std::uint64_t,
                                                              const TriangleView&,
                                                              const GatherInput&, TermWindow&,
                                                              const NormalWriter&) noexcept;

template std::uint64_t gather_listed_avx512<NormalWeight::uniform>(const Index*, std::uint64_t,
                                                                   const TriangleView&,
                                                                   const GatherInput&,
                                                                   const NormalWriter&) noexcept;
template std::uint64_t gather_listed_avx512<NormalWeight::area>(const Index*, std::uint64_t,
                                                                const TriangleView&,
                                                                const GatherInput&,
                                                                const NormalWriter&) noexcept;
template std::uint64_t gather_listed_avx512<NormalWeight::angle>(const Index*, std::uint64_t,
                                                                 const TriangleView&,
                                                                 const GatherInput&,
                                                                 const NormalWriter&) noexcept;
template std::uint64_t gather_listed_avx512<NormalWeight::max>(const Index*, std::uint64_t,
                                                               const TriangleView&,
                                                               const GatherInput&,
                                                               const NormalWriter&) noexcept;

}  // namespace hedgerow::kernels
