/* WebAssembly has no setjmp: cmocka.h of this folder does without. */
