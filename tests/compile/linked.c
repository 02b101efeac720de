/* Two functions of one program, each with a library of its own type.  With NEXT, main calls the other one. */
#include "gvi.h"

int linked_main(void);
int linked_other(void);
#ifdef NEXT
int main(void) { return linked_main() || linked_other(); }
#define linked linked_main
#elif defined(OTHER)
#define linked linked_other
#else
#define linked main
#endif

int linked(void)
{
    static gvi_real c[2], b[2], memory[GVI_LENGTH(1, 2, 2)];
    static gvi_desc desc;
    static gvi_stepper st;
    desc.n = 1;
    desc.degree = 2;
    if (gvi_stepper_size() != sizeof st || gvi_gauss(2, c, b) || b[1] < (gvi_real)0.49) return 1;
    return gvi_init(&st, &desc, memory, sizeof memory) || st.n != 1;
}
