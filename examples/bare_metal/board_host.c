/* The board of board.h on a computer: text to stdout, nobody waits for a clock.  */
#include "board.h"
#include <stdio.h>

void board_print(const char *text) { fputs(text, stdout); }

void board_every(unsigned hertz) { (void)hertz; }

int board_wait(void) { return 0; }
