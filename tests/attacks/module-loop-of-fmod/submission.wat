(module
  (import "env" "fmod" (func $fmod (param f64 f64) (result f64)))
  (func (export "km_forward_kinematics") (param $robot i32) (param $q i32) (param $position i32) 
    (loop $again (drop (call $fmod (f64.const 1e300) (f64.const 3e-300))) (br $again)))
  (memory (export "memory") 2)
  (func (export "km_version") (result i32) (i32.const 1))
  (func (export "km_buffer") (param i32) (result i32) (i32.const 1024)))
