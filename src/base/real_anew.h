/* real_anew.h - undefine the kind of number that earlier headers brought, so that bodies (*.inl) can be compiled once
 * more over another.  Products and quotients of real_scalar.h remain.  Without a guard: it may be included again. */
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
#undef REAL_MAX
#undef REAL_IS_SCALAR
#undef REAL_MASK
#undef REAL_LESS
#undef REAL_LESS_EQUAL
#undef REAL_EVERYWHERE
#undef REAL_ANY
#undef REAL_SELECT
#undef REAL_OF
#undef RHS_KIND
#undef REAL_BITS
#undef REAL_PAIR
#undef REAL_AS_BITS
#undef REAL_OF_BITS
