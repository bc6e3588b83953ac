(module
  (import "env" "pow" (func $pow (param f64 f64) (result f64)))
  (func (export "km_forward_kinematics") (param $robot i32) (param $q i32) (param $position i32) 
    (loop $again (drop (call $pow (f64.const 1.0000001) (f64.const 1e9))) (br $again)))
  (memory (export "memory") 2)
  (func (export "km_version") (result i32) (i32.const 1))
  (func (export "km_buffer") (param i32) (result i32) (i32.const 1024)))
