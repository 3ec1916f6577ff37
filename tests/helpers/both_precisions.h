/* both_precisions.h - the bodies of the model over double and over long double in one test, so that what the
 * one rounds is seen by the other. */
#ifndef FST_TESTS_BOTH_PRECISIONS_H
#define FST_TESTS_BOTH_PRECISIONS_H

#include "model/model.h"

#undef ENDS
#undef ENDS_GROUPS
#undef ENDS_OF
#undef ENDS_SQRT
#undef END
#undef REAL
#undef R
#undef FN
#undef REAL_SQRT
#undef REAL_ABS
#undef REAL_BITS
#undef REAL_AS_BITS
#undef REAL_OF_BITS
#undef REAL_PAIR

#include "physics_ld.h"

#endif
