/* One program, three units: this one, units_other.c, and the implementation in
   implementation.c.  All see the same types.  C99 and C++11.                  */
#include "gvi.h"

int other(gvi_stepper *st, gvi_real *memory, size_t size);

int main(void)
{
    static gvi_real memory[GVI_LENGTH(1, 3, 3)];
    gvi_stepper st;
    if (other(&st, memory, sizeof memory)) return 1;

    // half a turn of an oscillator: from 1 to -1
    for (int k = 0; k < 16; ++k)
        if (gvi_step(&st, (gvi_real)0.19634954084936207)) return 2;
    gvi_real miss = st.q[0] + 1;
    return miss < (gvi_real)1e-4 && miss > -(gvi_real)1e-4 ? 0 : 3;
}
