(module
  (import "kinemark" "log" (func $log (param i32 i32)))
  (data (i32.const 8) "\ff\fe\00\1b[2J\c0\80")
  (func (export "km_forward_kinematics") (param $robot i32) (param $q i32) (param $position i32) 
    (call $log (i32.const 8) (i32.const 9)) unreachable)
  (memory (export "memory") 2)
  (func (export "km_version") (result i32) (i32.const 1))
  (func (export "km_buffer") (param i32) (result i32) (i32.const 1024)))
