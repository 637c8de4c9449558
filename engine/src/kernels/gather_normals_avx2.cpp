// Eight vertices at a time.

#include "kernels/gather_rings.h"

namespace hedgerow::kernels {

#if defined(__AVX2__)

namespace {

struct Lanes8 {
  using Int = Int8;
  using Float = Float8;

  static Vec3<Float8> from_rows(const __m128* rows) noexcept {
    const auto pair = [rows](int i) {
      return _mm256_insertf128_ps(_mm256_castps128_ps256(rows[i]), rows[i + 4], 1);
    };
    return to_lanes(pair(0), pair(1), pair(2), pair(3));
  }
};
constexpr int kGroups = kSmallGroup / Int8::kLanes;  // walk at once: more do not fit the registers

}  // namespace

template <NormalWeight W>
std::uint64_t gather_group_avx2(Index first, Index size, std::uint64_t wanted,
                                const TriangleView& mesh, const GatherInput& input,
                                TermWindow& window, const NormalWriter& writer) noexcept {
  return with_loader(input.points, [&](const auto& loader) {
    std::uint64_t left = 0;
    for (Index i = 0; i < size; i += kSmallGroup) {
      left |= gather_rings<W, Lanes8, kGroups>(InRow{first + i}, wanted >> i, mesh, input, window,
                                               loader, writer)
              << i;
    }
    return left;
  });
}

template <NormalWeight W>
std::uint64_t gather_listed_avx2(const Index* ids, std::uint64_t wanted, const TriangleView& mesh,
                                 const GatherInput& input, const NormalWriter& writer) noexcept {
  TermWindow none;
  return with_loader(input.points, [&](const auto& loader) {
    return gather_rings<W, Lanes8, kGroups>(Listed{ids}, wanted, mesh, input, none, loader, writer);
  });
}

#else

template <NormalWeight W>
std::uint64_t gather_group_avx2(Index, Index, std::uint64_t wanted, const TriangleView&,
                                const GatherInput&, TermWindow&, const NormalWriter&) noexcept {
  return wanted;
}

template <NormalWeight W>
std::uint64_t gather_listed_avx2(const Index*, std::uint64_t wanted, const TriangleView&,
                                 const GatherInput&, const NormalWriter&) noexcept {
  return wanted;
}

#endif

template std::uint64_t gather_group_avx2<NormalWeight::uniform>(Index, Index, std::uint64_t,
                                                                const TriangleView&,
                                                                const GatherInput&, TermWindow&,
                                                                const NormalWriter&) noexcept;
template std::uint64_t gather_group_avx2<NormalWeight::area>(Index, Index, std::uint64_t,
                                                             const TriangleView&,
                                                             const GatherInput&, TermWindow&,
                                                             const NormalWriter&) noexcept;
template std::uint64_t gather_group_avx2<NormalWeight::angle>(Index, Index, std::uint64_t,
                                                              const TriangleView&,
                                                              const GatherInput&, TermWindow&,
                                                              const NormalWriter&) noexcept;
template std::uint64_t gather_group_avx2<NormalWeight::max>(Index, Index, std::uint64_t,
                                                            const TriangleView&, const GatherInput&,
                                                            TermWindow&,
                                                            const NormalWriter&) noexcept;

template std::uint64_t gather_listed_avx2<NormalWeight::uniform>(const Index*, std::uint64_t,
                                                                 const TriangleView&,
                                                                 const GatherInput&,
                                                                 const NormalWriter&) noexcept;
template std::uint64_t gather_listed_avx2<NormalWeight::area>(const Index*, std::uint64_t,
                                                              const TriangleView&,
                                                              const GatherInput&,
                                                              const NormalWriter&) noexcept;
template std::uint64_t gather_listed_avx2<NormalWeight::angle>(const Index*, std::uint64_t,
                                                               const TriangleView&,
                                                               const GatherInput&,
                                                               const NormalWriter&) noexcept;
template std::uint64_t gather_listed_avx2<NormalWeight::max>(const Index*, std::uint64_t,
                                                             const TriangleView&,
                                                             const GatherInput&,
                                                             const NormalWriter&) noexcept;

}  // namespace hedgerow::kernels
