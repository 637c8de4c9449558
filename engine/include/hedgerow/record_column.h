#pragma once

namespace hedgerow {

/// One member of an array of records, read as if it were a column. Owns nothing.
template <class Key, auto member, class Record>
struct MemberColumn {
  const Record* records = nullptr;

  auto operator[](Key key) const noexcept { return records[key.value].*member; }
};

/// An array of ids as a column. Owns nothing.
template <class Key, class Value>
struct IdColumn {
  const Value* ids = nullptr;

  Value operator[](Key key) const noexcept { return ids[key.value]; }
};

}  // namespace hedgerow
