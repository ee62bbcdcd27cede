; [name-missing] 2:5: error: GOTO has no block number (hint: write GOTO 100, or GOTO #1)
GOTO
