; [unknown-word] 2:6: error: unknown word S... after an O word (hint: O-word flow control (sub, while, if) is not read: write O1000 to M99 and call M98 P1000)
O100 sub
