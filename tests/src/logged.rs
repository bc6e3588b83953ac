//! The messages of a log as JSON, whichever way they are written, by a reader that is not the product's.

use prost_reflect::{DescriptorPool, DynamicMessage, SerializeOptions};
use serde_json::Value;

/// Topic and content of each message, in the order of the file.
pub(crate) fn messages(log: &[u8]) -> Vec<(String, Value)> {
    let messages = mcap::MessageStream::new(log).expect("MCAP").map(|message| {
        let message = message.expect("message");
        let channel = &message.channel;
        let schema = channel.schema.as_ref().expect("a schema");
        let content = match channel.message_encoding.as_str() {
            "json" => serde_json::from_slice(&message.data).expect("JSON"),
            _ => {
                let pool = DescriptorPool::decode(schema.data.as_ref()).expect("descriptors");
                let described = pool.get_message_by_name(&schema.name).expect("a message");
                let message = DynamicMessage::decode(described, message.data.as_ref());
                let options = SerializeOptions::new()
                    .use_proto_field_name(true)
                    .skip_default_fields(false);
                let message = message.expect("protobuf");
                message
                    .serialize_with_options(serde_json::value::Serializer, &options)
                    .expect("JSON")
            }
        };
        (channel.topic.clone(), content)
    });
    messages.collect()
}
