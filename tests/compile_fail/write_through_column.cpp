// A column of a view is read-only.
#include "hedgerow/column.h"

void cut(hedgerow::Column<hedgerow::HalfedgeId, hedgerow::HalfedgeId> opposite,
         hedgerow::Index* values) {
#ifdef HEDGEROW_WRONG
  opposite.data()[0] = values[0];
#else
  values[0] = opposite.data()[0];
#endif
}
