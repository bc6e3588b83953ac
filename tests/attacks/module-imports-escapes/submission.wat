(module
  (import "\1b[2J" "\e2\80\ae\1b]0;owned\07" (func))
  (memory (export "memory") 2)
  (func (export "km_version") (result i32) (i32.const 1))
  (func (export "km_buffer") (param i32) (result i32) (i32.const 1024)))
