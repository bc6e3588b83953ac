(module
  (type $two (func (param f64 f64) (result f64)))
  (func $none)
  (table funcref (elem $none))
  (func (export "km_forward_kinematics") (param $robot i32) (param $q i32) (param $position i32) 
    (drop (call_indirect (type $two) (f64.const 1) (f64.const 2) (i32.const 0))))
  (memory (export "memory") 2)
  (func (export "km_version") (result i32) (i32.const 1))
  (func (export "km_buffer") (param i32) (result i32) (i32.const 1024)))
