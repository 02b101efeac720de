/* The whole library, nothing else; included again before and after, which must do no harm. */
#include "gvi.h"
#define GVI_IMPLEMENTATION
#include "gvi.h"
#include "gvi.h"
