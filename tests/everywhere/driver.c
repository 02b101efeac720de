/* driver.c - runs bits.c compiled with -ffreestanding -DFREESTANDING

   All that it adds is a place for the text.                                    */
#include <stdio.h>

extern void bits_put(int character);
extern int bits_main(void);

void bits_put(int character) { putchar(character); }

int main(void) { return bits_main(); }
