/* What the programs of this folder need of a board: text out, a clock tick, an
   end.  board_mps2.c has it for Cortex-M3 and Cortex-M4F without an operating
   system, board_host.c for a computer.                                        */
#ifndef BOARD_H
#define BOARD_H

void board_print(const char *text);

/* A period of 1/hertz seconds begins now.  board_wait waits for its end, which
   begins the next; 1: it had ended before the call, so a deadline was missed.  */
void board_every(unsigned hertz);
int  board_wait(void);

#endif
