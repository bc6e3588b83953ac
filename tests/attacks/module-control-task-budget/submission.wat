(module
  (func (export "km_control") (param $observation i32) (param $command i32) (local $i i32)
    (loop $again
      (local.set $i (i32.add (local.get $i) (i32.const 1)))
      (br_if $again (i32.lt_u (local.get $i) (i32.const 90000))))
    (f64.store (local.get $command) (f64.const 0)) (f64.store offset=8 (local.get $command) (f64.const 0)))
  (memory (export "memory") 2)
  (func (export "km_version") (result i32) (i32.const 1))
  (func (export "km_buffer") (param i32) (result i32) (i32.const 1024)))
