/* bodies.inl - the model over REAL: its bodies in the order in which they build on each other.
 *
 * The including file says which kind of number REAL is (base/real_double.h, base/wide.h, ...), and brings
 * base/twofold.inl.  The derivative of all this along a direction, tangent.inl, is included where it is needed.
 */
#include "base/constants.h"
#include "base/elementary.h"
#include "model/kinds.h"
#include "model/quantities.h"

#include "model/source/sources.inl"
#include "model/contact/contacts.inl"
#include "model/world.inl"
#include "model/drive.inl"
#include "model/dynamics.inl"
#include "model/observe.inl"
