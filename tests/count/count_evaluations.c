#include "count_evaluations.h"

long long fst_test_evaluations = 0;
