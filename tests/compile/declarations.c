/* The declarations alone, twice, and every name that a user may take from them. */
#include "gvi.h"
#include "gvi.h"

int declared(const gvi_desc *desc, gvi_stepper *st, gvi_real *memory);
int declared(const gvi_desc *desc, gvi_stepper *st, gvi_real *memory)
{
    static gvi_real enough[GVI_LENGTH(3, 4, 5)];
    if (gvi_size(desc) > sizeof enough) return GVI_E_MEMORY;
    return gvi_init(st, desc, memory, gvi_size(desc));
}
